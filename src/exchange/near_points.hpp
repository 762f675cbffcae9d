// The points of an exchange that one of several ranks solves.
#pragma once

#include "exchange/exchange.hpp"

namespace dygita {

// Ranks that solve an iterated point: those that have its pieces, or all. Increasing.
std::vector<int> ranks_at(const Cut& cut, const Exchange& exchange, const Point& point);

// Leaves those that this rank solves: iterated ones that it has a piece of, or that are solved everywhere, and those in
// closed form that touch its pieces or share nodes with such.
void keep_near(const Cut& cut, Exchange& exchange);

// Collective: values of ports (`width` numbers each, of those of this exchange) of pieces elsewhere, from those who
// have them.
void receive_ports(const Cut& cut, const Exchange& exchange, int width, double* values);

// Numbers the unknowns of each piece in the order of the points; not is_all: collective, of pieces elsewhere as those
// who have them do.
void number_unknowns(const Cut& cut, bool is_all, Exchange& exchange);

}  // namespace dygita
