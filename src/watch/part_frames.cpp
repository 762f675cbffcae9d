#include "watch/part_frames.hpp"

#include <algorithm>
#include <sstream>

#include "watch/free_facets.hpp"
#include "watch/growth.hpp"

namespace dygita {

void PartFrames::fill(const Instant& instant) {
  if (!ranks::any(begun_.has_value())) return;
  views_.prepare(instant.model.cut);
  share();
  find_free_cells(instant);
  std::vector<NodalMotion> motion(begun_->parts.size());
  const auto take = [&](const char* name, NodalField field, Points NodalMotion::*to) {
    const std::vector<NamedField>& wanted = begun_->parts.front().fields;
    if (field != NodalField::displacement &&
        std::none_of(wanted.begin(), wanted.end(), [&](const NamedField& f) { return f.name == name; }))
      return;
    views_.take(instant, field);
    for (size_t i = 0; i < motion.size(); ++i)
      if (!views_.of(static_cast<int>(i)).is_empty()) motion[i].*to = views_.field(static_cast<int>(i));
  };
  take("displacement", NodalField::displacement, &NodalMotion::displacement);
  take("velocity", NodalField::velocity, &NodalMotion::velocity);
  take("acceleration", NodalField::acceleration, &NodalMotion::acceleration);
  for (size_t i = 0; i < motion.size(); ++i) {
    motion[i].growth = growth_at(instant, static_cast<int>(i));
    fill_part_here(static_cast<int>(i), motion[i]);
  }
  const Frame whole = std::move(*begun_);
  begun_.reset();
  sink_(whole);
}

void PartFrames::find_free_cells(const Instant& instant) {
  if (step_ == instant.model.step) return;
  step_ = instant.model.step;
  free_.assign(begun_->parts.size(), {});
  const std::vector<NamedField>& wanted = begun_->parts.front().fields;
  if (std::none_of(wanted.begin(), wanted.end(), [](const NamedField& f) { return f.name == "stress_error"; })) return;
  for (int part = 0; part < static_cast<int>(free_.size()); ++part) {
    const PartView& view = views_.of(part);
    const Mesh& whole = *problem_.substructures[static_cast<size_t>(part)]->mesh;
    if (view.is_empty() || !whole.has_cells()) continue;
    free_[static_cast<size_t>(part)] =
        free_cells(view.mesh(), free_facets(instant.model, part, boundary_facets(whole)), view.all_nodes());
  }
}

// Of a part that several ranks have, the nodes of the cells that are here.
void PartFrames::fill_part_here(int part, const NodalMotion& motion) {
  PartFrame& frame = begun_->parts[static_cast<size_t>(part)];
  const PartView& view = views_.of(part);
  if (!view.is_empty()) fill_part(view.mesh(), motion, free_[static_cast<size_t>(part)], frame);
  const std::vector<int> ranks = ranks_of(views_.cut(), part);
  if (ranks.size() == 1) return;
  frame.ranks = ranks;
  frame.rank = ranks::me();
  if (view.is_empty()) {
    for (auto& [name, values] : frame.fields) values.resize(components_of(name), 0);
    return;
  }
  shown_.resize(begun_->parts.size());
  PartView::Shown& shown = shown_[static_cast<size_t>(part)];
  if (!shown.mesh) shown = view.shown();
  frame.cells = shown.mesh;
  for (const int node : shown.nodes) frame.is_own.push_back(view.owner(node) >= 0);
  frame.displacement = Points(frame.displacement(Eigen::all, shown.nodes));
  for (auto& [name, values] : frame.fields) values = Mat(values(Eigen::all, shown.nodes));
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
