#include "result/spectrum_field.hpp"

#include <algorithm>
#include <map>

#include "mesh/facing.hpp"
#include "result/spectra.hpp"
#include "signal/srs.hpp"

namespace dygita {

namespace {

const std::vector<std::string> spectrum_names = {"maximax", "positive", "negative", "primary", "residual"};

const std::vector<double>& series(const Srs& srs, size_t i) {
  const std::vector<double>* all[] = {&srs.maximax, &srs.positive, &srs.negative, &srs.primary, &srs.residual};
  return *all[i];
}

}  // namespace

SpectrumField::SpectrumField(const Problem& problem, const Output& output) : problem_(problem), output_(output) {
  for (const Target& target : output.on) {
    const Face& face = std::get<Face>(target);
    const Mesh& mesh = *face.part->mesh;
    const FaceNodes on = face_nodes(mesh, face.facets());
    Area area{index_of(problem.substructures, face.part.get()),
              {face.label(), Points(3, on.nodes.size()), face.facets(), {}},
              on.nodes};
    std::map<int, int> point_of;
    for (size_t i = 0; i < on.nodes.size(); ++i) {
      point_of[on.nodes[i]] = static_cast<int>(i);
      area.faces.points.col(i) = mesh.nodes.col(on.nodes[i]) + face.part->place;
    }
    for (Facet& facet : area.faces.facets)
      for (int& node : facet.nodes()) node = point_of.at(node);
    areas_.push_back(std::move(area));
  }
}

void SpectrumField::accept(const Instant& instant) {
  if (instant.is_static()) return;
  const double dt = instant.model.scheme.dt;
  dt_ = dt_ == 0.0 ? dt : std::min(dt, dt_);
  time_.push_back(instant.time() - 0.5 * dt);
  std::vector<float> row;
  for (const Area& area : areas_) {
    const Points acceleration = instant.acceleration(area.part);
    for (const int node : area.nodes) {
      const Vec3 a = acceleration.col(node);
      if (output_.direction) {
        row.push_back(static_cast<float>(a.dot(*output_.direction)));
      } else {
        for (int d = 0; d < 3; ++d) row.push_back(static_cast<float>(a[d]));
      }
    }
  }
  signals_.push_back(std::move(row));
}

// One matrix a spectrum (maximax, positive, ...), frequencies x nodes; without a direction of the axis of largest
// maximax.
std::vector<Mat> SpectrumField::spectra(const Area& area, size_t first, std::vector<double>& frequency) const {
  const size_t n_directions = output_.direction ? 1 : 3;
  std::vector<Mat> all(spectrum_names.size());
  std::vector<double> value(time_.size());
  for (size_t i = 0; i < area.nodes.size(); ++i) {
    for (size_t d = 0; d < n_directions; ++d) {
      for (size_t t = 0; t < time_.size(); ++t)
        value[t] = static_cast<double>(signals_[t][first + n_directions * i + d]);
      const Srs srs = shock_response_spectrum(evenly(time_, value, dt_), dt_, output_.srs);
      frequency = srs.frequency;
      const auto n = static_cast<Eigen::Index>(frequency.size()), node = static_cast<Eigen::Index>(i);
      if (all[0].size() == 0)
        for (Mat& values : all) values = Mat::Zero(n, static_cast<Eigen::Index>(area.nodes.size()));
      for (Eigen::Index f = 0; f < n; ++f) {
        if (d > 0 && srs.maximax[static_cast<size_t>(f)] <= all[0](f, node)) continue;
        for (size_t k = 0; k < all.size(); ++k) all[k](f, node) = series(srs, k)[static_cast<size_t>(f)];
      }
    }
  }
  return all;
}

std::vector<Frame> SpectrumField::frames() const {
  std::vector<Frame> frames;
  if (time_.empty()) return frames;
  size_t first = 0;
  for (const Area& area : areas_) {
    std::vector<double> frequency;
    const std::vector<Mat> all = spectra(area, first, frequency);
    first += area.nodes.size() * (output_.direction ? 1 : 3);
    if (frames.empty()) {
      for (const double f : frequency) {
        frames.emplace_back();
        frames.back().time = frames.back().label_time = f;
        frames.back().step = output_.name;
      }
    }
    for (size_t f = 0; f < frames.size(); ++f) {
      InterfaceFrame faces = area.faces;
      for (size_t k = 0; k < all.size(); ++k)
        faces.fields.push_back({spectrum_names[k], all[k].row(static_cast<Eigen::Index>(f))});
      frames[f].interfaces.push_back(std::move(faces));
    }
  }
  return frames;
}

Table SpectrumField::table(const std::vector<Frame>& frames) const {
  const std::string unit = srs_unit(output_.srs.quantity, "m/s^2");
  Table table{{"frequency", "highest", "mean"}, {"Hz", unit, unit}, std::vector<std::vector<double>>(3), {}};
  for (const Frame& frame : frames) {
    double highest = 0.0, sum = 0.0, n = 0.0;
    for (const InterfaceFrame& faces : frame.interfaces) {
      const Mat& maximax = faces.fields.front().values;
      highest = std::max(highest, maximax.maxCoeff());
      sum += maximax.sum();
      n += static_cast<double>(maximax.size());
    }
    table.columns[0].push_back(frame.label_time);
    table.columns[1].push_back(highest);
    table.columns[2].push_back(sum / n);
  }
  return table;
}

}  // namespace dygita
