// The sections of a report, each as HTML; empty where the run has nothing for it.
#pragma once

#include <string>

#include "drawing/time_axis.hpp"
#include "files/run_folder.hpp"
#include "report/report.hpp"

namespace dygita {

std::string title_section(const RunFolder& run);
// What the run shows and how sure it is, in words and figures with their limits; warnings.
std::string verdict_section(const RunFolder& run, const ReportRequest& request);
// Total mass, each part's mass, material and bounding box.
std::string masses_section(const RunFolder& run);
// The largest value of every history, spectrum and joint, by name.
std::string peaks_section(const RunFolder& run, const TimeAxis& time, const ReportRequest& request);
std::string margins_section(const RunFolder& run);
std::string computed_section(const RunFolder& run);
std::string picture_section(const RunFolder& run);
// Where a part is nearest to its yield, where a contact slips and opens most: each from near.
std::string limits_section(const RunFolder& run);
std::string motion_section(const RunFolder& run);
std::string spectra_section(const RunFolder& run, const TimeAxis& time, const ReportRequest& request);
std::string condensed_section(const RunFolder& run);
std::string modes_section(const RunFolder& run);
// Of scenes.json, coloured by displacement.
std::string picture_of_shape(const Json& picture, const Json& parts, const std::string& title);
std::string attenuation_section(const RunFolder& run, const TimeAxis& time);
std::string histories_section(const RunFolder& run, const TimeAxis& time);
std::string bolts_section(const RunFolder& run);
std::string joints_section(const RunFolder& run, const TimeAxis& time);
std::string maps_of_joint(const RunFolder& run, const Json& joint);
// What each output.joint has met.
std::string table_of_joints(const RunFolder& run);
std::string energy_section(const RunFolder& run, const TimeAxis& time);
std::string convergence_section(const RunFolder& run);
std::string cost_section(const RunFolder& run);

// A section, and a drawing in it, that say so where the run has not converged: a figure is taken out of the page, a
// table is read without its top.
std::string doubted_section(const RunFolder& run, const std::string& title, const std::string& body_html);
std::string doubted_figure(const RunFolder& run, const std::string& drawing, const std::string& caption = {});

// The warnings of the record, those of a kind together, the first three in full.
std::string warnings_part(const Json& record);

// Does a column, or a curve, carry nothing but rounding beside the largest of its kind in the run?
inline bool is_rounding(double largest, double largest_of_run) { return !(largest > 1e-9 * largest_of_run); }

// What an output is of: "acceleration along z, on upper.top".
std::string subject_of(const Json& output);
// "half-sine, peak 100 MPa, duration 40 µs": a history as the record states it, of values in this unit.
std::string history_text(const std::string& description, const std::string& unit);

}  // namespace dygita
