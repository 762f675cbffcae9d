#include "law/point.hpp"

namespace dygita {

void LawState::add(const LawState& member, double share, const Mat3& frame) {
  gap += share * member.gap;
  plastic_opening += share * member.plastic_opening;
  hardening_opening += share * member.hardening_opening;
  opening_rate += share * member.opening_rate;
  slip += share * (frame.transpose() * member.slip);
  force += frame.transpose() * member.force;
  status = member.status;
}

LawState LawState::member(double share, const Mat3& frame) const {
  LawState state = *this;
  state.force = share * (frame * force);
  state.slip = frame * slip;
  state.rate = frame * rate;
  return state;
}

}  // namespace dygita
