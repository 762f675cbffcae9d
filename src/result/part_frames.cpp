#include "result/part_frames.hpp"

#include <sstream>

#include "result/frames.hpp"

namespace dygita {

void PartFrames::fill(const Instant& instant) {
  if (!ranks::any(begun_.has_value())) return;
  if (!cut_) {
    cut_ = instant.model.cut;
    nodes_ = WatchedNodes(*cut_, all_nodes(problem_));
  }
  share();
  const auto of_parts = [&](const char* name, NodalField field) {
    std::vector<Points> values(begun_->parts.size());
    const std::vector<NamedField>& wanted = begun_->parts.front().fields;
    if (std::string_view(name) != "displacement" &&
        std::none_of(wanted.begin(), wanted.end(), [&](const NamedField& f) { return f.name == name; }))
      return values;
    nodes_.take(instant, field);
    for (size_t i = 0; i < values.size(); ++i)
      if (is_watched_here(*cut_, static_cast<int>(i))) values[i] = nodes_.field(static_cast<int>(i));
    return values;
  };
  std::vector<Points> displacement = of_parts("displacement", NodalField::displacement);
  const std::vector<Points> velocity = of_parts("velocity", NodalField::velocity),
                            acceleration = of_parts("acceleration", NodalField::acceleration);
  for (size_t i = 0; i < displacement.size(); ++i) {
    if (!is_watched_here(*cut_, static_cast<int>(i))) continue;
    begun_->parts[i].displacement = std::move(displacement[i]);
    fill_part(begun_->parts[i], velocity[i], acceleration[i]);
  }
  const Frame whole = std::move(*begun_);
  begun_.reset();
  sink_(whole);
}

void PartFrames::share() {
  if (ranks::is_alone()) return;
  std::string fields;
  if (begun_)
    for (const NamedField& field : begun_->parts.front().fields) fields += field.name + ' ';
  std::istringstream names(ranks::shared(fields));
  const std::vector<double> times =
      ranks::shared(begun_ ? std::vector<double>{begun_->time, begun_->label_time, static_cast<double>(begun_->missed),
                                                 begun_->converged ? 1.0 : 0.0}
                           : std::vector<double>());
  const std::string step = ranks::shared(begun_ ? begun_->step : std::string());
  if (begun_) return;
  begun_.emplace();
  begun_->time = times[0], begun_->label_time = times[1], begun_->missed = static_cast<int>(times[2]);
  begun_->converged = times[3] != 0.0;
  begun_->step = step;
  std::vector<NamedField> wanted;
  for (std::string name; names >> name;) wanted.push_back({name, {}});
  for (const SubstructurePtr& part : problem_.substructures) {
    PartFrame& of_part = begun_->parts.emplace_back();
    of_part.part = part.get();
    of_part.fields = wanted;
  }
}

}  // namespace dygita
