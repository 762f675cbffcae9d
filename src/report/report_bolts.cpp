// What became of each bolt: its forces, and its loss by what took it.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "base/log.hpp"
#include "drawing/quantities.hpp"
#include "drawing/units.hpp"
#include "report/bolt_charts.hpp"
#include "report/html.hpp"
#include "report/report_parts.hpp"

namespace dygita {

namespace {

double by_hand(const Json& bolt, const char* key) { return number(bolt.value("hand", Json::object()), key); }

// NaN in runs of earlier versions, which have no split.
BoltLoss loss_of(const Json& bolt) {
  const double all = 100.0 * number(bolt, "loss"), yield = 100.0 * number(bolt, "loss_by_yield"),
               swing = 100.0 * std::abs(number(bolt, "swing") / number(bolt, "tightened"));
  double before = 100.0 * number(bolt, "loss_before_motion");
  if (!std::isfinite(before)) before = all - yield;  // nothing moves
  return {text(bolt, "name"), all, std::isfinite(swing) ? swing : 0.0, {yield, before, all - yield - before}};
}

std::vector<BoltLoss> losses_of(const Json& bolts) {
  std::vector<BoltLoss> losses;
  for (const Json& bolt : bolts)
    if (BoltLoss loss = loss_of(bolt); std::isfinite(loss.all) && std::isfinite(loss.by[0]))
      losses.push_back(std::move(loss));
  return losses;
}

constexpr size_t most_bars = 40;

// Of those whose loss is known, the least force first.
std::string force_figure(const RunFolder& run, const Json& bolts) {
  std::vector<BoltForce> rows;
  for (const Json& bolt : bolts) {
    const double given = number(bolt, "tightened");
    if (!std::isfinite(number(bolt, "loss")) || given == 0.0) continue;
    rows.push_back({text(bolt, "name"), 100.0 * number(bolt, "lowest") / given, 100.0 * number(bolt, "highest") / given,
                    100.0 * number(bolt, "last") / given});
  }
  if (rows.size() < 2) return "";
  std::stable_sort(rows.begin(), rows.end(), [](const auto& a, const auto& b) {
    return std::min(a.last, a.lowest) < std::min(b.last, b.lowest);
  });
  const size_t all = rows.size();
  if (rows.size() > most_bars) rows.resize(most_bars);
  return doubted_figure(
      run, force_chart(rows),
      "What each bolt has of its preload: light and black at the end, dark between the lowest and the "
      "highest force in the motion, dashed what its tightening gave; the least first." +
          (all > most_bars ? fmt::format(" {} more have more.", all - most_bars) : ""));
}

std::string loss_figure(const RunFolder& run, const Json& bolts) {
  std::vector<BoltLoss> losses = losses_of(bolts);
  constexpr double least = 0.1;  // %, that changes anything
  std::erase_if(losses, [](const BoltLoss& loss) {
    return std::max({std::abs(loss.all), std::abs(loss.by[0]), loss.swing}) <= least;
  });
  std::stable_sort(losses.begin(), losses.end(), [](const BoltLoss& a, const BoltLoss& b) { return a.all > b.all; });
  if (losses.size() > most_bars) losses.resize(most_bars);
  if (losses.empty()) return "";
  return doubted_figure(
      run, loss_chart(losses),
      "What is lost at the end of the run, of bolts that have lost or swing by more than 0.1 %. "
      "Yielding of the bolt: its mean plastic elongation since its own tightening times the stiffness "
      "that it showed while it was tightened. Other bolts and static loads: what else was gone when "
      "the motion began. The joint in the motion: the rest, which is slip and settling of contacts, "
      "and loads and motion that are still there at the end. Black bars: how far the force still "
      "swings in the last tenth of the motion.");
}

// Forces after each static step.
std::string history_table(const Json& bolts, const Json& steps) {
  std::vector<std::string> header = {"after step"};
  for (const Json& bolt : bolts) header.push_back(text(bolt, "name"));
  Cells rows;
  for (const Json& step : steps) {
    if (text(step, "kind") != "static") continue;
    std::vector<TableCell> row = {text(step, "name")};
    for (const Json& bolt : bolts) {
      const Json after = bolt.value("after_static", Json::array());
      row.push_back(rows.size() < after.size() && after[rows.size()].is_number()
                        ? TableCell(after[rows.size()].get<double>(), "N", 4)
                        : TableCell(""));
    }
    rows.push_back(std::move(row));
  }
  if (rows.size() < 2) return "";
  return html::folded("Force after each static step", html::table(header, in_common_units(rows), true));
}

// A column of the table of bolts: left out where no bolt has a value.
struct BoltColumn {
  const char *name, *unit;
  std::function<double(const Json&)> value;
  int digits = 3;
};

std::vector<BoltColumn> columns_of(bool has_motion) {
  const auto key = [](const char* name) { return [name](const Json& bolt) { return number(bolt, name); }; };
  std::vector<BoltColumn> columns = {
      {"asked for", "N", key("target"), 4},
      {"tightened to", "N", key("tightened"), 4},
      {"VDI 2230, same shortening", "N", [](const Json& bolt) { return by_hand(bolt, "force"); }, 4},
      {"shortened by", "m", key("shortening")}};
  if (has_motion) {
    columns.push_back({"lowest in motion", "N", key("lowest"), 4});
    columns.push_back({"highest in motion", "N", key("highest"), 4});
  }
  columns.push_back({"at the end", "N", key("last"), 4});
  columns.push_back({"lost", "%", [](const Json& bolt) { return 100.0 * number(bolt, "loss"); }});
  const auto by = [](size_t taker) { return [taker](const Json& bolt) { return loss_of(bolt).by[taker]; }; };
  columns.push_back({"by yielding", "%", by(0)});
  columns.push_back({"by other bolts, static loads", "%", by(1)});
  if (has_motion) columns.push_back({"by the joint in the motion", "%", by(2)});
  columns.push_back(
      {"mean stress", "Pa", [](const Json& bolt) { return number(bolt, "last") / number(bolt, "area"); }});
  columns.push_back({"residual opening", "m", key("plastic_opening")});
  columns.push_back({"proof load", "N", key("proof_load"), 4});
  columns.push_back({"margin: proof", "", key("margin_proof")});
  columns.push_back({"margin: slip", "", key("margin_slip")});
  columns.push_back({"margin: separation", "", key("margin_separation")});
  return columns;
}

// What the columns of margins mean, where there are any.
std::string margins_text(const Json& bolts) {
  std::string text;
  const auto has = [&](const char* key) {
    return std::any_of(bolts.begin(), bolts.end(), [&](const Json& bolt) { return bolt.contains(key); });
  };
  if (has("margin_proof"))
    text +=
        " Margins are what is left over 1, negative where a limit is passed; proof: of the proof load over the largest "
        "force, "
        "with the factor of safety on what loads added to the preload.";
  if (has("margin_slip"))
    text +=
        " Slip: the friction that the clamped contact around the bolt could carry over its shear, least in time. A "
        "joint that "
        "slides carries no more shear than its friction: its margin is then 1 over the factor of safety less 1, or "
        "less.";
  if (has("margin_separation"))
    text +=
        " Separation: of the load that would part the contact around the bolt over the largest that it saw, in "
        "proportion to "
        "the pressing force that is lost.";
  return text;
}

}  // namespace

std::string bolts_section(const RunFolder& run) {
  const Json bolts = run.record().value("bolts", Json::array());
  if (bolts.empty()) return "";
  const Json& steps = run.record().at("steps");
  const bool has_motion =
      std::any_of(steps.begin(), steps.end(), [](const Json& step) { return text(step, "kind") == "dynamic"; });
  std::vector<std::string> header = {"bolt"};
  Cells rows;
  for (const Json& bolt : bolts) rows.push_back({text(bolt, "name")});
  for (const BoltColumn& column : columns_of(has_motion)) {
    if (std::none_of(bolts.begin(), bolts.end(), [&](const Json& b) { return std::isfinite(column.value(b)); }))
      continue;
    header.push_back(column.name);
    for (size_t i = 0; i < bolts.size(); ++i) rows[i].emplace_back(column.value(bolts[i]), column.unit, column.digits);
  }
  return doubted_section(
      run, "Bolts",
      force_figure(run, bolts) + html::table(header, in_common_units(rows), true) +
          html::paragraph("Forces are those through the modelled part of each bolt, tension positive; lost: "
                          "relative to its own tightening, at the end; the mean stress is that at the end, "
                          "over the modelled area." +
                          margins_text(bolts)) +
          loss_figure(run, bolts) + history_table(bolts, steps));
}

}  // namespace dygita
