#include "step/joint_solves.hpp"

#include <algorithm>
#include <map>

#include "base/parallel.hpp"
#include "pieces/condensed_piece.hpp"

namespace dygita {

namespace joint {

namespace {

// Calls f(operator, items) for all items that are of one operator, sixteen of them at most, on the threads at hand.
template <class Operator, class Item, class Function>
void for_each_sixteen(const std::vector<std::pair<const Operator*, Item>>& items, Function&& f) {
  constexpr size_t most = 16;
  std::vector<std::pair<const Operator*, std::vector<Item>>> groups;
  std::map<const Operator*, size_t> open;
  for (const auto& [of, item] : items) {
    const auto it = open.find(of);
    if (it != open.end() && groups[it->second].second.size() < most) {
      groups[it->second].second.push_back(item);
      continue;
    }
    open[of] = groups.size();
    groups.push_back({of, {item}});
  }
  parallel_for(static_cast<int>(groups.size()),
               [&](int i) { f(*groups[static_cast<size_t>(i)].first, groups[static_cast<size_t>(i)].second); });
}

// What an iteration asks for last comes first, and the increment's last iterations before its end, since all wait for
// who has not converged.
constexpr int for_inner_iterations = 0, for_iterations = 1, for_increments = 2;

struct Products final : Asked {
  struct Product {
    Vec rhs;
    Vec* answer;
  };
  explicit Products(bool are_rough) : Asked(are_rough ? for_inner_iterations : for_iterations) {}
  void serve(std::span<Asked* const> all) override;
  void add(const SpdInverse* h, Vec rhs, Vec& answer) {
    answer.resize(h->size());
    products.emplace_back(h, Product{std::move(rhs), &answer});
  }

  std::vector<std::pair<const SpdInverse*, Product>> products;
};

void Products::serve(std::span<Asked* const> all) {
  std::vector<std::pair<const SpdInverse*, const Product*>> items;
  for (Asked* const one : all)
    for (const auto& [h, product] : static_cast<Products*>(one)->products) items.emplace_back(h, &product);
  for_each_sixteen(items, [this](const SpdInverse& h, const std::vector<const Product*>& own) {
    std::vector<const double*> from;
    std::vector<double*> to;
    for (const Product* const product : own) {
      from.push_back(product->rhs.data());
      to.push_back(product->answer->data());
    }
    urgency == for_inner_iterations ? h.multiply_roughly(from, to) : h.multiply(from, to);
  });
}

struct Substitutions final : Asked {
  explicit Substitutions(bool is_forward_one) : Asked(for_increments), is_forward(is_forward_one) {}
  void serve(std::span<Asked* const> all) override;

  const bool is_forward;
  std::vector<std::pair<const Factor*, Vec*>> vectors;
};

void substitute(const Factor& factor, bool is_forward, const std::vector<Vec*>& own) {
  constexpr size_t few = 4;
  std::vector<double*> x;
  for (Vec* const vector : own) x.push_back(vector->data());
  if (own.size() >= few) return is_forward ? factor.forward_together(x) : factor.backward_together(x);
  for (Vec* const vector : own) is_forward ? factor.forward(*vector) : factor.backward(*vector);
}

void Substitutions::serve(std::span<Asked* const> all) {
  for (const bool now_forward : {true, false}) {
    std::vector<std::pair<const Factor*, Vec*>> items;
    for (Asked* const one : all)
      if (const auto* own = static_cast<Substitutions*>(one); own->is_forward == now_forward)
        items.insert(items.end(), own->vectors.begin(), own->vectors.end());
    for_each_sixteen(items, [now_forward](const Factor& factor, const std::vector<Vec*>& own) {
      substitute(factor, now_forward, own);
    });
  }
}

// Null: what the piece solves, it solves by itself.
CondensedPiece* condensed_piece(const StepModel& model, int i) {
  return dynamic_cast<CondensedPiece*>(model.pieces[static_cast<size_t>(i)].get());
}

}  // namespace

void forward(StepModel& model) {
  Substitutions all(true);
  std::vector<CondensedPiece*> moved;
  for (const int i : model.here) {
    CondensedPiece* const piece = condensed_piece(model, i);
    Vec* const x = piece ? piece->to_substitute_forward() : nullptr;
    if (!x) continue;
    moved.push_back(piece);
    all.vectors.emplace_back(&piece->factor(), x);
  }
  if (!moved.empty()) Turns::at_hand()->ask(all);
  for (CondensedPiece* const piece : moved) piece->take_forward();
}

void backward(StepModel& model) {
  Substitutions all(false);
  for (const int i : model.here) {
    CondensedPiece* const piece = condensed_piece(model, i);
    Vec* const x = piece ? piece->to_substitute_backward() : nullptr;
    if (x) all.vectors.emplace_back(&piece->factor(), x);
  }
  if (!all.vectors.empty()) Turns::at_hand()->ask(all);
}

void interface_velocities(StepModel& model, const Vec& q, Vec& velocity) {
  Products all(false);
  const auto of_piece = [&](auto& vector, int i) {
    return vector.segment(model.near.start(i), model.pieces[static_cast<size_t>(i)]->n_rows());
  };
  std::vector<int> asking;
  for (const int i : model.here) {
    Piece& piece = *model.pieces[static_cast<size_t>(i)];
    CondensedPiece* const condensed = condensed_piece(model, i);
    if (!condensed) {
      piece.interface_velocity(of_piece(q, i), of_piece(velocity, i));
      continue;
    }
    Vec rhs;
    const SpdInverse* const h = condensed->to_multiply(of_piece(q, i), of_piece(velocity, i), rhs);
    if (!h) continue;
    asking.push_back(i);
    all.add(h, std::move(rhs), condensed->product());
  }
  if (!asking.empty()) Turns::at_hand()->ask(all);
  for (const int i : asking) condensed_piece(model, i)->take_product(of_piece(velocity, i));
}

void rough_changes(StepModel& model, const Vec& change, Vec& velocity) {
  Products all(true);
  std::vector<std::pair<int, Vec>> asking;  // whose answers stay where they are
  asking.reserve(model.here.size());
  const auto of_piece = [&](auto& vector, int i) {
    return vector.segment(model.near.start(i), model.pieces[static_cast<size_t>(i)]->n_rows());
  };
  for (const int i : model.here) {
    CondensedPiece* const condensed = condensed_piece(model, i);
    Vec rhs;
    const SpdInverse* const h = condensed ? condensed->to_multiply_roughly(of_piece(change, i), rhs) : nullptr;
    if (!h) {
      model.pieces[static_cast<size_t>(i)]->rough_change(of_piece(change, i), of_piece(velocity, i));
      continue;
    }
    all.add(h, std::move(rhs), asking.emplace_back(i, Vec()).second);
  }
  if (!asking.empty()) Turns::at_hand()->ask(all);
  for (const auto& [i, answer] : asking) condensed_piece(model, i)->take_rough_product(answer, of_piece(velocity, i));
}

}  // namespace joint

}  // namespace dygita
