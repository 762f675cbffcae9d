// output.srs_field: shock response spectra at every node of faces.
#include <algorithm>
#include <map>

#include "base/task.hpp"
#include "meeting/facing.hpp"
#include "model/refusal.hpp"
#include "recording/output_table.hpp"
#include "recording/recorder.hpp"
#include "recording/spectra.hpp"

namespace dygita {

namespace {

const std::vector<double>& part_of(const Srs& srs, size_t i) {
  const std::vector<double>* all[] = {&srs.maximax, &srs.positive, &srs.negative, &srs.primary, &srs.residual};
  return *all[i];
}

struct FieldRequest {
  std::string name;
  std::vector<Target> on;         // faces
  std::optional<Vec3> direction;  // unit; none: the axis of largest maximax, node by node
  SrsSettings srs;

  size_t n_directions() const { return direction ? 1 : 3; }
};

// Accelerations of every node of the faces through the dynamic steps, and their spectra at the end.
class FieldRecorder : public Recorder {
 public:
  FieldRecorder(const Columns& columns, const Problem& problem, const FieldRequest& request)
      : columns_(columns), request_(request) {
    for (const Target& target : request.on) {
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

  void accept(const Instant& instant) override {
    missed_so_far_ += !instant.converged;
    if (instant.is_static()) return;
    missed_ = missed_so_far_;
    const double dt = instant.interval();
    dt_.push_back(dt);
    time_.push_back(instant.time() - 0.5 * dt);
    std::vector<float> row;
    for (const Area& area : areas_) {
      const Points acceleration = instant.acceleration(area.part, area.nodes);
      for (Eigen::Index i = 0; i < acceleration.cols(); ++i) {
        const Vec3 a = acceleration.col(i);
        if (request_.direction) {
          row.push_back(static_cast<float>(a.dot(*request_.direction)));
        } else {
          for (int d = 0; d < 3; ++d) row.push_back(static_cast<float>(a[d]));
        }
      }
    }
    signals_.push_back(std::move(row));
  }

  void finish(Table& table, Findings& findings) override {
    findings.frames = frames();
    table = table_of(findings.frames);
    table.mark(missed_ == 0);
  }

 private:
  struct Area {
    int part;
    InterfaceFrame faces;  // points and facets
    std::vector<int> nodes;
  };

  // One matrix a spectrum (maximax, positive, ...), frequencies x nodes; without a direction of the axis of largest
  // maximax.
  std::vector<Mat> spectra(const Area& area, size_t first, std::vector<double>& frequency) const {
    const size_t n_directions = request_.n_directions();
    std::vector<Mat> all(std::size(spectrum_names));
    std::vector<double> value(time_.size());
    Task task("spectra of '" + request_.name + "'", static_cast<int>(area.nodes.size()), Task::Interrupts::wait);
    for (size_t i = 0; i < area.nodes.size(); ++i) {
      for (size_t d = 0; d < n_directions; ++d) {
        for (size_t t = 0; t < time_.size(); ++t)
          value[t] = static_cast<double>(signals_[t][first + n_directions * i + d]);
        const Srs srs = shock_response_spectrum(stretches_of(time_, dt_, value), request_.srs);
        frequency = srs.frequency;
        const auto n = static_cast<Eigen::Index>(frequency.size()), node = static_cast<Eigen::Index>(i);
        if (all[0].size() == 0)
          for (Mat& values : all) values = Mat::Zero(n, static_cast<Eigen::Index>(area.nodes.size()));
        for (Eigen::Index f = 0; f < n; ++f) {
          if (d > 0 && srs.maximax[static_cast<size_t>(f)] <= all[0](f, node)) continue;
          for (size_t k = 0; k < all.size(); ++k) all[k](f, node) = part_of(srs, k)[static_cast<size_t>(f)];
        }
      }
      task.done("nodes");
    }
    return all;
  }

  // A frame a frequency, label_time in Hz: all spectra on the faces.
  std::vector<Frame> frames() const {
    std::vector<Frame> frames;
    if (time_.empty()) return frames;
    size_t first = 0;
    for (const Area& area : areas_) {
      std::vector<double> frequency;
      const std::vector<Mat> all = spectra(area, first, frequency);
      first += area.nodes.size() * request_.n_directions();
      if (frames.empty()) {
        for (const double f : frequency) {
          frames.emplace_back();
          frames.back().time = frames.back().label_time = f;
          frames.back().step = request_.name;
          frames.back().converged = missed_ == 0;
          frames.back().missed = missed_;
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

  // Highest and mean maximax over the nodes.
  Table table_of(const std::vector<Frame>& frames) const {
    Table table = empty_table(columns_);
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

  const Columns columns_;
  const FieldRequest& request_;
  std::vector<Area> areas_;
  std::vector<double> time_, dt_;            // s, middle and length of each increment
  std::vector<std::vector<float>> signals_;  // of each instant: nodes of all areas x directions, m/s^2
  int missed_so_far_ = 0, missed_ = 0;       // increments that have not converged; those that the signals rest on
};

class SrsFieldOutput final : public Output {
 public:
  explicit SrsFieldOutput(const ModelArguments& a) : Output(a), request_{name, a.targets("on"), {}, srs_settings(a)} {
    if (a.has("direction")) request_.direction = a.unit_vector("direction");
  }

  void check(const Problem& problem) const override {
    check::is_on(problem, *this, request_.on, [](const Target& target) {
      return std::holds_alternative<Face>(target) ? "" : "output.srs_field takes faces";
    });
    if (name == problem.name || name == "interfaces")
      check::fail(problem, origin, known_as() + " would overwrite " + name + ".pvd",
                  "the problem's own name and 'interfaces' are those of the run's frames");
    check_spectrum(problem, *this, request_.srs);
  }

  Columns columns() const override {
    return {{"frequency", "Hz"}, {"highest", spectrum_unit(request_.srs)}, {"mean", spectrum_unit(request_.srs)}};
  }

  Notes record(const Table&, const Findings&) const override {
    Notes notes;
    note_targets(request_.on, notes);
    note_direction(request_.direction, notes);
    return notes;
  }

  std::vector<StudyFigure> study_figures() const override { return {{"highest", StudyFigure::Of::largest}}; }
  std::unique_ptr<Recorder> recorder(const Problem& problem, const FrameSink&) const override {
    return std::make_unique<FieldRecorder>(columns(), problem, request_);
  }
  std::optional<double> highest_frequency() const override { return request_.srs.to; }

 private:
  FieldRequest request_;
};

}  // namespace

namespace outputs {
OutputEntry srs_field() { return {"srs_field", new_output<SrsFieldOutput>, {Display::As::nothing, "", 0}}; }
}  // namespace outputs

}  // namespace dygita
