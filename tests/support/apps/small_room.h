// A room of 4 m x 3 m x 2.5 m with two luminaires, simulated and then fitted to its readings: an OUT in two
// seconds.
//
// Names hold what ends a script and opens an element in HTML.
#ifndef LUXFIT_TESTS_SUPPORT_APPS_SMALL_ROOM_H_
#define LUXFIT_TESTS_SUPPORT_APPS_SMALL_ROOM_H_

#include <gtest/gtest.h>

#include <sstream>
#include <string>

#include "tests/support/apps/program.h"
#include "tests/support/temp_folder.h"

namespace luxfit::support {

constexpr char kHostileName[] = "</script><script>luxfitInjected=1</script><b>&amp;";

inline std::string SmallRoomSession(const std::string& luminaires, const std::string& luxmeter) {
  const std::string id = kHostileName;
  return "name = \"" + id +
         "\"\n[scene]\nmesh = \"room.obj\"\n[scene.albedo]\nwall = 0.6\nfloor = 0.3\n[states]\nboth = { \"" +
         id + "\" = 1.0, B = 1.0 }\nhalf = { \"" + id + "\" = 0.5 }\n" + luminaires +
         "[luxmeter]\nreadings = \"luxmeter.csv\"\n" + luxmeter;
}

inline std::string SmallRoomLuminaires(const std::string& flux) {
  return "[[luminaire]]\nid = \"" + std::string(kHostileName) +
         "\"\nphotometry = \"lambertian\"\nshape = \"disc\"\nsize_m = [0.4]\nposition_m = [1.0, 1.5, 2.4]\n"
         "position_sigma_m = 0\naim = [0, 0, -1]\n" +
         flux +
         "[[luminaire]]\nid = \"B\"\nphotometry = \"cosine_power\"\ncosine_exponent = 2.0\nshape = "
         "\"rectangle\"\nsize_m = [0.6, "
         "0.3]\nposition_m = [3.0, 1.5, 2.4]\nposition_sigma_m = 0\naim = [0, 0, -1]\n" +
         flux;
}

// Eight points in both states, with the given illuminances or none.
inline std::string SmallRoomReadings(const std::string& simulated_csv) {
  std::istringstream rows(simulated_csv);
  std::string row, csv = "id,x_m,y_m,z_m,nx,ny,nz,state,lux\n";
  std::getline(rows, row);
  for (const char* state : {"both", "half"}) {
    for (int i = 0; i < 8; ++i) {
      std::string lux;
      if (std::getline(rows, row)) lux = row.substr(row.find(',', row.find(',') + 1) + 1);
      lux = lux.substr(0, lux.find(','));
      csv += "P" + std::to_string(i) + "," + std::to_string(0.5 + i % 4) + "," + std::to_string(1 + i / 4) +
             ",0.8,0,0,1," + state + "," + lux + "\n";
    }
  }
  return csv;
}

// Leaves FOLDER/out, of `luxfit fit`.
inline void FitSmallRoom(const TempFolder& folder) {
  folder.Write(
      "room.obj",
      "v 0 0 0\nv 4 0 0\nv 4 3 0\nv 0 3 0\nv 0 0 2.5\nv 4 0 2.5\nv 4 3 2.5\nv 0 3 2.5\n"
      "usemtl floor\nf 1 2 3 4\nusemtl wall\nf 8 7 6 5\nf 1 5 6 2\nf 2 6 7 3\nf 3 7 8 4\nf 4 8 5 1\n");
  folder.Write("luxmeter.csv", SmallRoomReadings(""));
  folder.Write("given.toml", SmallRoomSession(SmallRoomLuminaires("flux_lm = 1000\n"), ""));
  const ProgramRun simulated =
      RunProgram("simulate '" + folder.Path("given.toml") + "' -o '" + folder.Path("simulated") + "'");
  ASSERT_EQ(simulated.status, 0) << simulated.output;
  folder.Write("luxmeter.csv", SmallRoomReadings(folder.Read("simulated/illuminance.csv")));
  folder.Write("session.toml", SmallRoomSession(SmallRoomLuminaires(""), "fit = [\"P0\", \"P3\", \"P5\"]\n"));
  const ProgramRun fitted =
      RunProgram("fit '" + folder.Path("session.toml") + "' -o '" + folder.Path("out") + "'");
  ASSERT_EQ(fitted.status, 0) << fitted.output;
}

}  // namespace luxfit::support

#endif  // LUXFIT_TESTS_SUPPORT_APPS_SMALL_ROOM_H_
