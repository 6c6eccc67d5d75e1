#include "inverse/model/internal/channel_transports.h"

#include <utility>

namespace luxfit {
namespace {

bool AreEqual(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return a.rows() == b.rows() && a.cols() == b.cols() && a == b;
}

}  // namespace

std::vector<Eigen::VectorXd> ChannelAlbedo(const Eigen::VectorXd& albedo, const Eigen::Matrix3Xd& tint) {
  constexpr double kMostAlbedo = 0.99;
  if (tint.size() == 0) return {albedo};
  std::vector<Eigen::VectorXd> channels;
  for (const auto& of_channel : tint.rowwise())
    channels.emplace_back(albedo.cwiseProduct(of_channel.transpose()).cwiseMin(kMostAlbedo));
  return channels;
}

ChannelTransports::ChannelTransports(const Room& room, const Room& exchange, Eigen::VectorXd albedo,
                                     Eigen::Matrix3Xd tint, Eigen::VectorXd patch_factor)
    : albedo_(std::move(albedo)),
      tint_(std::move(tint)),
      patch_factor_(std::move(patch_factor)),
      grey_(exchange.transport, albedo_) {
  for (const Eigen::VectorXd& channel : ChannelAlbedo(albedo_, tint_))
    channels_.emplace_back(room.transport, channel, patch_factor_);
}

bool ChannelTransports::Serve(const Eigen::VectorXd& albedo, const Eigen::Matrix3Xd& tint,
                              const Eigen::VectorXd& patch_factor, double still_albedo) const {
  return albedo.size() == albedo_.size() && (albedo - albedo_).lpNorm<Eigen::Infinity>() <= still_albedo &&
         AreEqual(tint, tint_) && AreEqual(patch_factor, patch_factor_);
}

}  // namespace luxfit
