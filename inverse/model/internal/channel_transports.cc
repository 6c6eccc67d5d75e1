#include "inverse/model/internal/channel_transports.h"

#include <utility>

namespace luxfit {
namespace {

bool AreEqual(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return a.rows() == b.rows() && a.cols() == b.cols() && a == b;
}

}  // namespace

ChannelTransports::ChannelTransports(const Room& room, const Room& exchange, Eigen::VectorXd albedo,
                                     Eigen::Matrix3Xd tint, Eigen::VectorXd patch_factor)
    : albedo_(std::move(albedo)),
      tint_(std::move(tint)),
      patch_factor_(std::move(patch_factor)),
      grey_(exchange.transport, albedo_) {
  constexpr Eigen::Index kChannels = 3;
  channels_.reserve(kChannels);
  if (tint_.size() == 0) channels_.emplace_back(room.transport, albedo_, patch_factor_);
  for (Eigen::Index c = 0; c < kChannels && tint_.size() > 0; ++c) {
    constexpr double kMostAlbedo = 0.99;
    channels_.emplace_back(room.transport,
                           albedo_.cwiseProduct(tint_.row(c).transpose()).cwiseMin(kMostAlbedo).eval(),
                           patch_factor_);
  }
}

bool ChannelTransports::Serve(const Eigen::VectorXd& albedo, const Eigen::Matrix3Xd& tint,
                              const Eigen::VectorXd& patch_factor, double still_albedo) const {
  return albedo.size() == albedo_.size() && (albedo - albedo_).lpNorm<Eigen::Infinity>() <= still_albedo &&
         AreEqual(tint, tint_) && AreEqual(patch_factor, patch_factor_);
}

}  // namespace luxfit
