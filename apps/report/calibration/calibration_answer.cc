#include "apps/report/calibration/calibration_answer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "apps/charts/svg.h"
#include "apps/report/html.h"
#include "apps/text/with_sigma.h"
#include "calib/lens/lens_family.h"

namespace luxfit {
namespace {

using nlohmann::json;

constexpr double kShownMmPerM = 1000, kDegPerRad = 180 / M_PI;

std::string Px(double px) { return std::isfinite(px) ? fmt::format("{:.3f} px", px) : "not determined"; }

std::string NameOfLens(const RecordedGroup& group) {
  return group.lens.empty() ? "none" : ToString(*LensKindOf(group.lens));
}

// Returns the warnings that leave the calibration undetermined, or the others.
std::vector<json> Warnings(const json& artifact, bool leave_undetermined) {
  const auto because = artifact.value("status_because", std::vector<std::string>());
  std::vector<json> warnings;
  for (const json& warning : artifact.at("warnings")) {
    const bool is_cause = std::find(because.begin(), because.end(), warning.at("code")) != because.end();
    if (is_cause == leave_undetermined) warnings.push_back(warning);
  }
  return warnings;
}

int InUse(const RecordedGroup& group) {
  return static_cast<int>(
      std::count_if(group.images.begin(), group.images.end(),
                    [](const RecordedImage& image) { return image.outliers < image.corners; }));
}

std::string Cards(const RecordedGroup& group) {
  const auto given = group.images.size() + group.left_out.size();
  std::vector<HtmlCard> cards = {
      {"reprojection error", fmt::format("{:.3f}", group.rms_px), "px",
       fmt::format("rms per axis; {:.3f} px as a distance; {:.1f} % of the corners left out", group.rms_2d_px,
                   100 * group.outlier_share)},
      {"on photos held out",
       std::isfinite(group.held_out_px) ? fmt::format("{:.3f}", group.held_out_px) : "–",
       std::isfinite(group.held_out_px) ? "px" : "",
       std::isfinite(group.held_out_px) ? "rms per axis" : "too few photos to hold any out"},
      {"photos", fmt::format("{}", InUse(group)), fmt::format("of {}", given), "used"}};
  if (group.cameras.size() > 1) {
    const RecordedCamera& camera = group.cameras[1];
    cards.push_back({fmt::format("baseline, {} to {}", group.cameras[0].id, camera.id),
                     fmt::format("{:.2f}", kShownMmPerM * camera.baseline_m), "mm",
                     std::isfinite(camera.baseline_sigma_m)
                         ? fmt::format("± {:.2g} mm", kShownMmPerM * camera.baseline_sigma_m)
                         : "sigma not determined"});
  }
  return HtmlCards(cards);
}

// Returns a table of the lens' parameters, one column a camera.
std::string LensTable(const RecordedGroup& group) {
  std::vector<HtmlColumn> columns = {{"Intrinsics", false}};
  for (const RecordedCamera& camera : group.cameras) columns.push_back({camera.id, true});
  const std::vector<std::string>& names = group.cameras.front().parameter_names;
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < names.size(); ++i) {
    rows.push_back({names[i]});
    for (const RecordedCamera& camera : group.cameras) {
      const auto at = static_cast<Eigen::Index>(i);
      rows.back().push_back(at < camera.parameters.size()
                                ? WithSigma(camera.parameters[at], camera.parameter_sigmas[at])
                                : "–");
    }
  }
  rows.push_back({"image, px"});
  rows.push_back({"sigma in the middle*, px"});
  rows.push_back({"median sigma*, px"});
  const bool has_circle = std::any_of(group.cameras.begin(), group.cameras.end(),
                                      [](const RecordedCamera& c) { return !c.circle.IsWholePicture(); });
  rows.push_back({std::string("above the limit*, % of the image") + (has_circle ? " circle" : "")});
  if (has_circle) rows.push_back({"radius of the image circle, px"});
  for (const RecordedCamera& camera : group.cameras) {
    rows[names.size()].push_back(fmt::format("{} × {}", camera.width_px, camera.height_px));
    rows[names.size() + 1].push_back(fmt::format("{:.2g}", camera.middle_sigma_px));
    rows[names.size() + 2].push_back(fmt::format("{:.2g}", camera.median_sigma_px));
    rows[names.size() + 3].push_back(fmt::format("{:.1f}", 100 * camera.uncertain_share));
    if (has_circle)
      rows[names.size() + 4].push_back(camera.circle.IsWholePicture()
                                           ? "all of the image"
                                           : fmt::format("{:.0f}", camera.circle.radius_px));
  }
  return HtmlTable(columns, rows);
}

std::string DegText(const Eigen::Vector3d& vector_rad) {
  const Eigen::Vector3d deg = kDegPerRad * vector_rad;
  return fmt::format("{:.3f}, {:.3f}, {:.3f}", deg.x(), deg.y(), deg.z());
}

// Returns a table of the poses of the rig's further cameras against its first one.
std::string RigTable(const RecordedGroup& group) {
  if (group.cameras.size() < 2) return "";
  std::vector<HtmlColumn> columns = {{fmt::format("Extrinsics, {} to", group.cameras.front().id), false}};
  std::vector<std::vector<std::string>> rows = {{"baseline, mm"},
                                                {"rotation, degrees"},
                                                {"translation x, mm"},
                                                {"translation y, mm"},
                                                {"translation z, mm"},
                                                {"rotation vector x, y, z, degrees"},
                                                {"sigma of a turn about x, y, z, degrees"}};
  for (std::size_t c = 1; c < group.cameras.size(); ++c) {
    const RecordedCamera& camera = group.cameras[c];
    const Eigen::AngleAxisd turn(camera.cam_from_rig.linear());
    const Eigen::Vector3d place_mm = kShownMmPerM * camera.cam_from_rig.translation(),
                          sigma_mm = kShownMmPerM * camera.translation_sigma_m;
    columns.push_back({camera.id, true});
    rows[0].push_back(WithSigma(kShownMmPerM * camera.baseline_m, kShownMmPerM * camera.baseline_sigma_m));
    rows[1].push_back(WithSigma(camera.rotation_deg, camera.rotation_sigma_deg));
    for (int axis = 0; axis < 3; ++axis)
      rows[2 + static_cast<std::size_t>(axis)].push_back(WithSigma(place_mm[axis], sigma_mm[axis]));
    rows[5].push_back(DegText(turn.angle() * turn.axis()));
    rows[6].push_back(DegText(camera.rotation_sigma_rad));
  }
  return "<div>" + HtmlTable(columns, rows) +
         HtmlParagraph(
             "Translation t and rotation R take points of the first camera to the other one: R p + t, "
             "as OpenCV's stereoCalibrate gives them. Axes: x right, y down, z forward.",
             "note") +
         "</div>\n";
}

std::string GroupAnswer(const RecordedGroup& group, bool is_alone) {
  const std::string names = CameraNames(group);
  std::string html = is_alone ? "" : HtmlHeading(3, names.empty() ? "Not calibrated" : names);
  if (group.lens.empty()) return html + HtmlParagraph("Nothing was calibrated: see the findings.", "notice");
  // Half a page is wide enough for the columns of two cameras.
  const std::string tables = LensTable(group) + RigTable(group);
  html += Cards(group) + (group.cameras.size() > 2 ? tables : HtmlSideBySide(tables));
  return html + HtmlParagraph(fmt::format("Lens model: {}, {}.", NameOfLens(group),
                                          group.lens_because.empty() ? "as given" : group.lens_because));
}

std::string Finding(const json& warning, bool is_cause) {
  return fmt::format(
      "<li><div class=\"message\">{}{}</div><div class=\"remedy\"><b>Remedy: </b>{}</div></li>\n",
      is_cause ? "<b>Undetermined: </b>" : "", XmlEscaped(warning.at("message").get<std::string>()),
      XmlEscaped(warning.at("remedy").get<std::string>()));
}

std::string FindingsHtml(const json& artifact) {
  const bool is_done = artifact.at("status") == "done";
  std::string items;
  for (const bool is_cause : {true, false}) {
    for (const json& warning : Warnings(artifact, is_cause)) items += Finding(warning, is_cause);
  }
  const char* title = is_done ? (items.empty() ? "Every gate passed." : "Every gate passed; to look at:")
                              : "Gates that failed, and what to do";
  return fmt::format("<div class=\"findings {}\"><h3>{}</h3>{}</div>\n", is_done ? "done" : "undetermined",
                     title, items.empty() ? "" : "<ul>" + items + "</ul>");
}

}  // namespace

std::string Verdict(const CalibrationRecord& record) {
  const json& artifact = *record.artifact;
  if (artifact.at("status") != "done") {
    const std::vector<json> causes = Warnings(artifact, true);
    std::string why;
    for (const json& warning : causes)
      why += (why.empty() ? "" : "; ") + warning.at("message").get<std::string>();
    return "Not usable as it is: " + (why.empty() ? "a gate failed" : why) + ".";
  }
  std::string errors;
  for (const RecordedGroup& group : record.groups)
    errors += fmt::format("; {}: reprojection error {} per axis, {} on photos held out", CameraNames(group),
                          Px(group.rms_px), Px(group.held_out_px));
  return "Usable: every gate passed" + errors + ".";
}

std::string AnswerSection(const CalibrationRecord& record) {
  std::string html = fmt::format("<p class=\"verdict\"><b>{}</b></p>\n", XmlEscaped(Verdict(record)));
  for (const RecordedGroup& group : record.groups) html += GroupAnswer(group, record.groups.size() == 1);
  html += HtmlParagraph(
      "± is one sigma; *: of the pixel of a direction, over the image. Sigmas hold the noise of the corners, "
      "and not an error "
      "of the board: squares that are 1 % larger than stated make the baseline 1 % too short.",
      "note");
  return HtmlSection("answer", "The answer", "", html + FindingsHtml(*record.artifact));
}

}  // namespace luxfit
