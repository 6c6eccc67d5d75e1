#include "apps/session/session_corrections.h"

#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

#include "tests/support/office_truth.h"

namespace luxfit {
namespace {

using support::kOfficeFolder;

SessionCorrections Some(const Session& session) {
  SessionCorrections corrections;
  corrections.dimming["evening"] = {{"A", 0.7}, {"C", 1}};
  corrections.photos = {{"cam0", "v01", "A", "B"}, {"cam0", "v01", "B", "A"}};
  SessionReading row = session.luxmeter.readings.front();
  row.position_m = {1, 2, 0.5};
  row.normal = -Eigen::Vector3d::UnitZ();
  row.state = "B";
  row.illuminance_lx = 12;
  corrections.readings = {row};
  MeshMove move;
  move.right_from_given.translation() = Eigen::Vector3d(0.1, -0.2, 0);
  move.is_furniture_alone = true;
  corrections.mesh = move;
  return corrections;
}

std::string StateOf(const Session& session, const std::string& name) {
  for (const SessionPhoto& photo : session.photos)
    if (photo.file.find(name) != std::string::npos) return photo.state;
  return "";
}

class Corrections : public testing::Test {
 protected:
  const Session session_ = ReadSession(kOfficeFolder + "session.toml");
};

TEST_F(Corrections, ChangeWhatTheyNameAndNothingElse) {
  const Session right = Corrected(session_, Some(session_));
  const std::map<std::string, double> evening{{"A", 0.7}, {"C", 1}};
  for (size_t s = 0; s < right.states.size(); ++s) {
    const SessionState& state = right.states[s];
    EXPECT_EQ(state.dimming, state.id == "evening" ? evening : session_.states[s].dimming);
  }
  EXPECT_EQ(StateOf(right, "v01_A"), "B");
  EXPECT_EQ(StateOf(right, "v01_B"), "A");
  EXPECT_EQ(StateOf(right, "v02_A"), "A");
  const SessionReading &first = right.luxmeter.readings[0], &second = right.luxmeter.readings[1];
  EXPECT_EQ(first.position_m, Eigen::Vector3d(1, 2, 0.5));
  EXPECT_EQ(first.normal, Eigen::Vector3d(0, 0, -1));
  EXPECT_EQ(first.state, "B");
  EXPECT_EQ(first.illuminance_lx, 12);
  EXPECT_EQ(second.position_m, session_.luxmeter.readings[1].position_m);
  ASSERT_TRUE(right.scene->mesh_move);
  EXPECT_TRUE(right.scene->mesh_move->is_furniture_alone);
}

TEST_F(Corrections, AreTheSameReadBackFromJson) {
  const nlohmann::json written = CorrectionsJson(Some(session_));
  EXPECT_EQ(CorrectionsJson(CorrectionsFromJson(written)), written);
  EXPECT_TRUE(CorrectionsFromJson(CorrectionsJson({})).IsEmpty());
}

TEST_F(Corrections, OfAnotherSessionAreRefused) {
  SessionCorrections of_state;
  of_state.dimming["night"] = {{"A", 1}};
  EXPECT_THROW(Corrected(session_, of_state), std::invalid_argument);
  SessionCorrections of_reading;
  of_reading.readings.resize(1);
  of_reading.readings[0].line = 9999;
  EXPECT_THROW(Corrected(session_, of_reading), std::invalid_argument);
}

}  // namespace
}  // namespace luxfit
