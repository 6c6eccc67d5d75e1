#include "apps/report/calibration/calibration_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "apps/charts/svg.h"
#include "apps/report/calibration/calibration_answer.h"
#include "apps/report/calibration/calibration_pictures.h"
#include "apps/report/html.h"
#include "apps/report/report_page.h"
#include "apps/report/shown_paths.h"
#include "apps/text/formats/json_vectors.h"
#include "apps/version.h"

namespace luxfit {
namespace {

using nlohmann::json;

std::string Header(const CalibrationRecord& record) {
  const bool is_done = record.artifact->at("status") == "done";
  return fmt::format(
      "<header><div class=\"title\"><h1>{}</h1><p>Cameras as calibrated: lenses, rig, and how well they are "
      "known. "
      "<span class=\"nowrap\">{}</span>, luxfit {}</p></div><div class=\"actions\"><span class=\"status "
      "{}\">{}</span>"
      "</div></header>\n",
      XmlEscaped(record.artifact->at("session").get<std::string>()), NowUtc(), kVersion,
      is_done ? "done" : "undetermined", is_done ? "usable" : "not usable as it is");
}

struct Part {
  std::string id, name, html;  // the name is that of the link to it
};

std::string Navigation(const std::vector<Part>& parts) {
  std::string links;
  for (const Part& part : parts) links += fmt::format("<a href=\"#{}\">{}</a>", part.id, part.name);
  return "<div class=\"bar no-print\"><nav aria-label=\"Parts of the report\">" + links + "</nav></div>\n";
}

// Returns the distance of the board's middle, mm. A room's tags have none: a camera stands among them.
std::string DistanceText(const RecordedGroup& group, const RecordedImage& image) {
  if (group.board.empty()) return "–";
  return fmt::format("{:.0f}", 1000 * (image.cam_from_target * group.target.center()).norm());
}

std::string PhotoTable(const RecordedGroup& group) {
  std::vector<std::vector<std::string>> rows;
  for (const RecordedImage& image : group.images) {
    const bool is_used = image.outliers < image.corners;
    rows.push_back({image.file, image.camera, is_used ? fmt::format("{:.3f}", image.rms_px) : "–",
                    fmt::format("{}", image.corners), fmt::format("{}", image.outliers),
                    DistanceText(group, image),
                    is_used ? "used" : "left out: too few of its corners fit for a pose"});
  }
  for (const LeftOutImage& image : group.left_out)
    rows.push_back({image.file, image.camera, "–", "–", "–", "–", "left out: " + image.reason});
  return HtmlTable({{"Photo", false},
                    {"Camera", false},
                    {"rms per axis, px", true},
                    {"corners", true},
                    {"of them left out", true},
                    {"distance, mm", true},
                    {"use", false}},
                   rows);
}

std::string PhotoSection(const CalibrationRecord& record) {
  std::string html;
  for (const RecordedGroup& group : record.groups)
    html += HtmlParagraph(fmt::format("Target: {}{}.",
                                      group.board.empty() ? "the room's surveyed tags" : group.board,
                                      group.is_rig ? "; photos of a set share one pose of it" : "")) +
            PhotoTable(group);
  return HtmlSection("photos", "Photos", "", html);
}

std::string ChoiceSection(const json& artifact) {
  std::string html = "<dl class=\"choices\">\n";
  for (const json& choice : artifact.at("choices")) {
    std::string among;
    for (const json& candidate : choice.at("among"))
      among += (among.empty() ? "" : ", ") + candidate.get<std::string>();
    html +=
        fmt::format("<dt>{}: <b>{}</b></dt><dd>{}{}</dd>\n", XmlEscaped(choice.at("what").get<std::string>()),
                    XmlEscaped(choice.at("chosen").get<std::string>()),
                    XmlEscaped(choice.at("because").get<std::string>()),
                    among.empty() ? "" : "; among " + XmlEscaped(among));
  }
  return HtmlSection("choices", "Choices and why", "", html + "</dl>\n");
}

// Returns the folders below which the page names files.
std::vector<std::string> FoldersOf(const CalibrationRecord& record) {
  std::vector<std::string> inputs;
  for (const auto& [file, hash] : record.artifact->at("inputs").items()) inputs.push_back(file);
  return {CommonFolder(inputs), record.out};
}

std::string ProvenanceSection(const CalibrationRecord& record, const std::string& command_line) {
  const json& artifact = *record.artifact;
  const std::vector<std::string> folders = FoldersOf(record);
  std::string files;
  for (const json& file : artifact.at("files"))
    files += (files.empty() ? "" : ", ") + file.get<std::string>();
  std::string hashes;
  for (const auto& [file, hash] : artifact.at("inputs").items())
    hashes += fmt::format("<tr><td>{}</td><td><code>{}</code></td></tr>\n",
                          XmlEscaped(WithoutFolders(file, folders)), XmlEscaped(hash.get<std::string>()));
  return HtmlSection("provenance", "Provenance", "",
                     HtmlPairs({{"Session", artifact.at("session")},
                                {"Made by", "luxfit " + artifact.at("luxfit_version").get<std::string>()},
                                {"Command", WithoutFolders(artifact.at("command"), folders)},
                                {"Report", WithoutFolders(command_line, folders)},
                                {"Report written", NowUtc()},
                                {"Files of the cameras", files}}) +
                         HtmlDetails(fmt::format("{} input files with their hashes (XXH3, 128 bit)",
                                                 artifact.at("inputs").size()),
                                     "<div class=\"scroll\"><table class=\"hashes\"><tbody>\n" + hashes +
                                         "</tbody></table></div>\n"));
}

// Tells whether anything was calibrated that could be drawn.
bool HasCameras(const CalibrationRecord& record) {
  return std::any_of(record.groups.begin(), record.groups.end(),
                     [](const RecordedGroup& group) { return !group.cameras.empty(); });
}

json CameraSummary(const RecordedCamera& camera) {
  return {{"id", camera.id},
          {"fx_px", camera.parameters[0]},
          {"fy_px", camera.parameters[1]},
          {"fx_sigma_px", NumberOrNull(camera.parameter_sigmas[0])},
          {"fy_sigma_px", NumberOrNull(camera.parameter_sigmas[1])},
          {"median_sigma_px", NumberOrNull(camera.median_sigma_px)},
          {"baseline_m", camera.baseline_m},
          {"baseline_sigma_m", NumberOrNull(camera.baseline_sigma_m)},
          {"rotation_deg", camera.rotation_deg},
          {"rotation_sigma_deg", NumberOrNull(camera.rotation_sigma_deg)}};
}

}  // namespace

std::string CalibrationPage(const CalibrationRecord& record, const std::string& command_line) {
  CalibrationRecord shown = record;
  shown.artifact = std::make_shared<json>(JsonWithoutFolders(*record.artifact, FoldersOf(record)));
  std::vector<Part> parts = {{"answer", "Answer", AnswerSection(shown)}};
  if (HasCameras(record)) {
    parts.push_back({"residuals", "Residuals", ResidualSection(record)});
    parts.push_back({"coverage", "Coverage", CoverageSection(record)});
    parts.push_back({"uncertainty", "Uncertainty", UncertaintySection(record)});
    parts.push_back({"rig", "Cameras and boards", RigSection(record)});
  }
  parts.push_back({"photos", "Photos", PhotoSection(record)});
  parts.push_back({"choices", "Choices", ChoiceSection(*shown.artifact)});
  parts.push_back({"provenance", "Provenance", ProvenanceSection(record, command_line)});
  std::string html = Header(record) + Navigation(parts) + "<main>\n";
  for (const Part& part : parts) html += part.html;
  return ReportPageWithoutProgram(record.artifact->at("session"), html + "</main>\n");
}

json CalibrationSummary(const CalibrationRecord& record) {
  json groups = json::array();
  for (const RecordedGroup& group : record.groups) {
    json cameras = json::array();
    for (const RecordedCamera& camera : group.cameras) cameras.push_back(CameraSummary(camera));
    groups.push_back({{"usable", group.is_usable},
                      {"lens", group.lens.empty() ? json() : json(group.lens)},
                      {"rms_px", group.rms_px},
                      {"held_out_rms_px", NumberOrNull(group.held_out_px)},
                      {"images", group.images.size()},
                      {"images_left_out", group.left_out.size()},
                      {"cameras", cameras}});
  }
  return {{"session", record.artifact->at("session")},
          {"status", record.artifact->at("status")},
          {"verdict", Verdict(record)},
          {"groups", groups}};
}

}  // namespace luxfit
