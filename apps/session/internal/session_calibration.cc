#include "apps/session/internal/session_calibration.h"

#include "calib/lens/lens_family.h"

namespace luxfit {

std::vector<std::string> RigRules() { return {"auto", "names", "numbers", "order", "none"}; }

SessionCalibration ReadCalibrationSection(const TomlCursor& section) {
  section.ExpectKeys({"lens", "back_end", "rig", "focal_start_px"});
  SessionCalibration calibration;
  if (const auto lens = section.Find("lens")) {
    const std::string expected =
        "auto, opencv4, opencv5, opencv8, opencv12, fisheye, or splinedN with N control points along the "
        "width";
    const std::string name = lens->Text(expected);
    calibration.lens = name == "auto" ? std::nullopt : LensKindOf(name);
    if (name != "auto" && (!calibration.lens || (OpsOf(calibration.lens->lens).has_control_points &&
                                                 calibration.lens->knots == 0)))
      throw lens->Error("expected " + expected + ", got " + lens->Shown());
  }
  if (const auto back_end = section.Find("back_end"))
    calibration.back_end = back_end->OneOf({"mrcal", "opencv"});
  if (calibration.back_end == "opencv" && calibration.lens && !OpsOf(calibration.lens->lens).is_in_opencv)
    throw section.Error("expected back_end = \"mrcal\" with a splined lens, got \"opencv\"");
  if (const auto rig = section.Find("rig")) calibration.rig = rig->OneOf(RigRules());
  if (const auto focal = section.Find("focal_start_px"))
    calibration.focal_start_px = focal->NumberAbove(0, "px");
  return calibration;
}

}  // namespace luxfit
