#include "calib/luminance/colour_profile.h"

#include <lcms2.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <exiv2/exiv2.hpp>
#include <memory>
#include <vector>

#include "calib/photo_files/internal/exif.h"
#include "calib/photo_files/internal/heif_photo.h"

namespace luxfit {
namespace {

constexpr int kLevels = 256;

// Counts that increase are needed: a curve that is flat at its dark end gets this slope there.
Eigen::VectorXd Increasing(Eigen::VectorXd curve) {
  constexpr double kLeastStep = 1e-7;
  for (Eigen::Index i = 1; i < curve.size(); ++i) curve[i] = std::max(curve[i], curve[i - 1] + kLeastStep);
  return curve / curve[curve.size() - 1];
}

ColourProfile OfOneCurve(const std::string& name, double (*decoded)(double)) {
  const Eigen::VectorXd curve =
      Increasing(Eigen::VectorXd::LinSpaced(kLevels, 0, 1).unaryExpr([&](double v) { return decoded(v); }));
  return {name, {curve, curve, curve}};
}

double Pq(double v) {
  constexpr double kM1 = 2610.0 / 16384, kM2 = 2523.0 / 4096 * 128, kC1 = 3424.0 / 4096, kC2 = 2413.0 / 128,
                   kC3 = 2392.0 / 128;
  const double root = std::pow(v, 1 / kM2);
  return std::pow(std::max(root - kC1, 0.0) / (kC2 - kC3 * root), 1 / kM1);
}

double Hlg(double v) {
  constexpr double kA = 0.17883277, kB = 1 - 4 * kA;
  static const double kC = 0.5 - kA * std::log(4 * kA);
  return v <= 0.5 ? v * v / 3 : (std::exp((v - kC) / kA) + kB) / 12;
}

std::optional<ColourProfile> OfTransfer(int transfer) {
  switch (transfer) {
    case 4:
      return OfOneCurve("power of 2.2", [](double v) { return std::pow(v, 2.2); });
    case 5:
      return OfOneCurve("power of 2.8", [](double v) { return std::pow(v, 2.8); });
    case 8:
      return OfOneCurve("linear", [](double v) { return v; });
    case 16:
      return OfOneCurve("PQ (SMPTE ST 2084)", Pq);
    case 18:
      return OfOneCurve("HLG (ARIB STD-B67)", Hlg);
    default:
      return std::nullopt;
  }
}

std::string NameOf(cmsHPROFILE profile) {
  std::array<char, 128> text{};
  cmsGetProfileInfoASCII(profile, cmsInfoDescription, "en", "US", text.data(), text.size() - 1);
  return text.data();
}

// Returns the primaries before their adaptation to D50. Profiles of version 2 may leave out how that was done: by Bradford's
// transform from D65, as nearly all do.
std::optional<Eigen::Matrix3d> PrimariesOf(cmsHPROFILE profile) {
  Eigen::Matrix3d adapted, adaptation;
  const std::array<cmsTagSignature, 3> tags{cmsSigRedColorantTag, cmsSigGreenColorantTag,
                                            cmsSigBlueColorantTag};
  for (int c = 0; c < 3; ++c) {
    const auto* const xyz = static_cast<const cmsCIEXYZ*>(cmsReadTag(profile, tags[static_cast<size_t>(c)]));
    if (xyz == nullptr) return std::nullopt;
    adapted.col(c) << xyz->X, xyz->Y, xyz->Z;
  }
  adaptation << 1.0478, 0.0229, -0.0501, 0.0296, 0.9905, -0.0171, -0.0092, 0.0151, 0.7517;
  if (const auto* const chad =
          static_cast<const cmsCIEXYZ*>(cmsReadTag(profile, cmsSigChromaticAdaptationTag))) {
    for (int row = 0; row < 3; ++row) adaptation.row(row) << chad[row].X, chad[row].Y, chad[row].Z;
  }
  Eigen::Matrix3d matrix = adaptation.inverse() * adapted;
  if (!matrix.allFinite() || !(matrix.row(1).sum() > 0)) return std::nullopt;
  return matrix;
}

std::optional<ColourProfile> OfIcc(const std::vector<std::uint8_t>& bytes) {
  if (bytes.empty()) return std::nullopt;
  const std::unique_ptr<void, int (*)(cmsHPROFILE)> profile(
      cmsOpenProfileFromMem(bytes.data(), static_cast<cmsUInt32Number>(bytes.size())), cmsCloseProfile);
  if (!profile || cmsGetColorSpace(profile.get()) != cmsSigRgbData) return std::nullopt;
  ColourProfile found{NameOf(profile.get()), {}, PrimariesOf(profile.get())};
  const std::array<cmsTagSignature, 3> tags{cmsSigRedTRCTag, cmsSigGreenTRCTag, cmsSigBlueTRCTag};
  for (size_t c = 0; c < tags.size(); ++c) {
    const auto* const curve = static_cast<const cmsToneCurve*>(cmsReadTag(profile.get(), tags[c]));
    if (curve == nullptr) return std::nullopt;
    Eigen::VectorXd values(kLevels);
    for (int i = 0; i < kLevels; ++i)
      values[i] = static_cast<double>(cmsEvalToneCurveFloat(curve, static_cast<float>(i) / (kLevels - 1)));
    if (!values.allFinite() || !(values[kLevels - 1] > 0.5)) return std::nullopt;
    found.curves[c] = Increasing(std::move(values));
  }
  return found;
}

}  // namespace

CameraResponse ColourProfile::Response(double full_scale_counts) const {
  const Eigen::VectorXd counts = full_scale_counts * Eigen::VectorXd::LinSpaced(kLevels, 0, 1);
  const double of_srgb = SrgbResponse(full_scale_counts).RelativeSigma(0, 0.5 * full_scale_counts);
  const Eigen::VectorXd sigma = Eigen::VectorXd::Constant(kLevels, of_srgb);
  return CameraResponse(counts, curves).WithRelativeSigma({sigma, sigma, sigma});
}

double ColourProfile::DifferenceFromSrgb() const {
  const CameraResponse srgb = SrgbResponse(kLevels - 1);
  double largest = 0;
  for (size_t c = 0; c < curves.size(); ++c) {
    for (int i = kLevels / 20; i < kLevels; ++i)
      largest = std::max(largest, std::abs(std::log(curves[c][i] / srgb.Exposure(c, i))));
  }
  return largest;
}

std::optional<ColourProfile> ReadColourProfile(const std::string& path) {
  if (!IsHeifName(path)) return OfIcc(ReadIccProfile(path));
  const HeifProfile profile = ReadHeifProfile(path);
  if (std::optional<ColourProfile> icc = OfIcc(profile.icc)) return icc;
  return OfTransfer(profile.transfer);
}

}  // namespace luxfit
