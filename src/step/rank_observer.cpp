#include "step/rank_observer.hpp"

#include "step/distant_piece.hpp"

namespace dygita {

namespace {

template <class Watch>
void watch_or_answer(const Instant& instant, Watch&& watch) {
  if (ranks::is_first()) {
    watch();
    ranks::release_all();
    return;
  }
  ranks::answer_until_released([&](const ranks::Question& question, std::span<const double> with) {
    if (question.what == DistantPoints::asked) return instant.distant->answer(question.of);
    return answer_for(*instant.model.pieces.at(static_cast<size_t>(question.of)), question.what, with);
  });
}

}  // namespace

void RankObserver::begin_step(const Instant& start) {
  watch_or_answer(start, [&] { observer_.begin_step(start); });
}

void RankObserver::accept(const Instant& instant) {
  watch_or_answer(instant, [&] { observer_.accept(instant); });
}

}  // namespace dygita
