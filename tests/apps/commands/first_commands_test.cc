// The commands that a newcomer meets first, as typed: init, doctor, explain, help, completions, manual pages.
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <set>

#include "apps/commands/result/explain_command.h"
#include "apps/session/session.h"
#include "tests/paths.h"
#include "tests/support/apps/office_copy.h"
#include "tests/support/apps/program.h"
#include "tests/support/temp_folder.h"

namespace luxfit {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

const std::string kOffice = std::string(LUXFIT_FIXTURES) + "/office";

support::ProgramRun InitOffice(const std::string& out) {
  return support::RunProgram("init --photos " + kOffice + "/photos --mesh " + kOffice + "/room.obj --tags " +
                             kOffice + "/tags.json -o " + out);
}

std::vector<std::string> CommandsOfHelp() {
  const std::string help = support::RunProgram("--help").output;
  std::vector<std::string> commands;
  const std::regex line("\n  ([a-z]+) {2,}");
  for (std::sregex_iterator at(help.begin(), help.end(), line), end; at != end; ++at)
    commands.push_back((*at)[1]);
  return commands;
}

// Results name the session's file. A name that is not UTF-8 was replaced in them, and the report at the end found no session.
TEST(RunTest, AFolderWhoseNameIsNotUtf8IsNamedAtOnce) {
  const TempFolder folder;
  const std::string place = folder.Path("caf\xe9");
  fs::create_directories(place);
  fs::copy(kOffice, place, fs::copy_options::recursive);
  const support::ProgramRun from =
      support::RunProgram("run '" + place + "/session.toml' -o " + folder.Path("out"));
  EXPECT_EQ(from.status, 2) << from.output;
  EXPECT_THAT(from.output, AllOf(HasSubstr("caf\u00e9/session.toml: expected a path in UTF-8"),
                                 HasSubstr("0xE9, which in Windows-1252 is \"\u00e9\"; rename the folder")));
  const support::ProgramRun into =
      support::RunProgram("run " + kOffice + "/session.toml -o '" + place + "/out'");
  EXPECT_EQ(into.status, 2) << into.output;
  EXPECT_FALSE(fs::exists(folder.Path("out")));
  EXPECT_FALSE(fs::exists(place + "/out"));
}

TEST(InitTest, WritesASessionThatReads) {
  const TempFolder folder;
  const support::ProgramRun init = InitOffice(folder.Path("mine"));
  ASSERT_EQ(init.status, 0) << init.output;
  EXPECT_THAT(init.output, HasSubstr("exposure_s of 49 photos"));
  const Session session = ReadSession(folder.Path("mine/session.toml"));
  const Session office = ReadSession(kOffice + "/session.toml");
  EXPECT_EQ(session.photos.size(), office.photos.size());
  EXPECT_EQ(session.tags.survey.size(), office.tags.survey.size());
  EXPECT_EQ(session.states.size(), office.states.size());
  EXPECT_EQ(session.cameras[0].intrinsics, office.cameras[0].intrinsics);
  EXPECT_EQ(session.scene->unit, "m");
  for (size_t i = 0; i < office.photos.size(); ++i) EXPECT_EQ(session.photos[i].view, office.photos[i].view);
}

TEST(InitTest, MarksEveryGuess) {
  const TempFolder folder;
  ASSERT_EQ(InitOffice(folder.Path("mine")).status, 0);
  std::istringstream lines(folder.Read("mine/session.toml"));
  for (std::string line; std::getline(lines, line);) {
    const bool is_set = line.find('=') != std::string::npos && line[0] != '#';
    const bool was_told = line.rfind("name", 0) == 0 || line.rfind("id ", 0) == 0 ||
                          line.rfind("mesh", 0) == 0 || line.rfind("map", 0) == 0;
    if (is_set && !was_told) {
      EXPECT_THAT(line, HasSubstr("# GUESS: "));
    }
  }
}

TEST(InitTest, WritesOverNothing) {
  const TempFolder folder;
  folder.Write("mine/photos.csv", "precious\n");
  const support::ProgramRun init = InitOffice(folder.Path("mine"));
  EXPECT_EQ(init.status, 2);
  EXPECT_THAT(init.output, HasSubstr("photos.csv: expected a new file, found one"));
  EXPECT_EQ(folder.Read("mine/photos.csv"), "precious\n");
  EXPECT_FALSE(fs::exists(folder.Path("mine/session.toml")));
}

TEST(InitTest, GuessesTheUnit) {
  const TempFolder folder;
  folder.Write("room.obj", "v 0 0 0\nv 6000 0 0\nv 6000 4000 0\nv 0 4000 0\nusemtl floor\nf 1 2 3 4\n");
  const support::ProgramRun init =
      support::RunProgram("init --photos " + kOffice + "/photos --mesh " + folder.Path("room.obj") + " -o " +
                          folder.Path("mine"));
  ASSERT_EQ(init.status, 0) << init.output;
  EXPECT_THAT(folder.Read("mine/session.toml"), HasSubstr("unit = \"mm\""));
}

support::ProgramRun InitWithoutMesh(const std::string& options, const std::string& out) {
  return support::RunProgram("init --photos " + kOffice + "/photos " + options + " -o " + out);
}

TEST(InitTest, TakesThreeLengths) {
  const TempFolder folder;
  for (const char* size : {"6 4 2.8", "6x4x2.8"}) {
    const std::string out = folder.Path(std::string("mine") + size[1]);
    const support::ProgramRun init =
        InitWithoutMesh("--tags " + kOffice + "/tags.json --size " + size, "'" + out + "'");
    ASSERT_EQ(init.status, 0) << init.output;
    const std::string text = folder.Read(std::string("mine") + size[1] + "/session.toml");
    EXPECT_THAT(text,
                AllOf(HasSubstr("\nsize = [6, 4, 2.8]\n"), HasSubstr("# \"wall 1\" = 0.5   # 16.8 m2")));
    EXPECT_EQ(ReadSession(out + "/session.toml").scene->outline->heights_m, std::vector<double>{2.8});
  }
  for (const char* size : {"6 4", "6x4", "6 4 0", "6 4 high", "nan 1 1"}) {
    const support::ProgramRun init = InitWithoutMesh(std::string("--size ") + size, folder.Path("bad"));
    EXPECT_EQ(init.status, 2) << size;
    EXPECT_THAT(init.output, HasSubstr("--size: expected three lengths in m")) << size;
    EXPECT_FALSE(fs::exists(folder.Path("bad"))) << size;
  }
}

TEST(InitTest, GuessesTheRoomFromTags) {
  const TempFolder folder;
  const support::ProgramRun init = InitWithoutMesh("--tags " + kOffice + "/tags.json", folder.Path("mine"));
  ASSERT_EQ(init.status, 0) << init.output;
  EXPECT_THAT(init.output, HasSubstr("- [scene]: measure the room; its lengths are a guess"));
  EXPECT_THAT(folder.Read("mine/session.toml"),
              HasSubstr("size = [6, 4, 2.5]   # GUESS: as far as 9 tags on walls reach, and a usual height"));
  // Tags that are surveyed from elsewhere: the room's corner is not the origin.
  std::string tags = "[";
  for (int i = 0; i < 4; ++i) {
    const double x = i == 0 ? 1 : (i == 1 ? 6 : 3), y = i == 2 ? -2 : (i == 3 ? 2 : 0);
    tags += (i > 0 ? ", " : "") + std::string("{\"id\": ") + std::to_string(i) +
            ", \"size_m\": 0.2, \"center_m\": [" + std::to_string(x) + ", " + std::to_string(y) +
            ", 2.7], \"normal\": [" + (i < 2 ? (i == 0 ? "1, 0" : "-1, 0") : (i == 2 ? "0, 1" : "0, -1")) +
            ", 0], \"up\": [0, 0, 1]}";
  }
  folder.Write("tags.json", tags + "]");
  ASSERT_EQ(InitWithoutMesh("--tags " + folder.Path("tags.json"), folder.Path("other")).status, 0);
  EXPECT_THAT(folder.Read("other/session.toml"),
              AllOf(HasSubstr("outline = [[1, -2], [6, -2], [6, 2], [1, 2]]   # GUESS: "),
                    HasSubstr("height = 2.8   # GUESS: ")));
  EXPECT_EQ(ReadSession(folder.Path("other/session.toml")).scene->outline->corners_m.size(), 4U);
}

TEST(InitTest, AsksForThreeLengthsWhereNothingTellsTheRoom) {
  const TempFolder folder;
  const support::ProgramRun init = InitWithoutMesh("", folder.Path("mine"));
  EXPECT_EQ(init.status, 2);
  EXPECT_THAT(init.output,
              AllOf(HasSubstr("--size: expected the room's three lengths"),
                    HasSubstr("type: luxfit init --photos " + kOffice + "/photos --size 6 4 2.8 -o ")));
  EXPECT_FALSE(fs::exists(folder.Path("mine")));
}

TEST(DoctorTest, SaysWhatASessionLacks) {
  const support::ProgramRun good = support::RunProgram("doctor " + kOffice + "/session.toml");
  EXPECT_EQ(good.status, 0);
  EXPECT_THAT(good.output,
              AllOf(HasSubstr("views are placed by tags"), HasSubstr("v08"), Not(HasSubstr("bad "))));
  const TempFolder folder;
  ASSERT_EQ(InitOffice(folder.Path("mine")).status, 0);
  const support::ProgramRun bad = support::RunProgram("doctor " + folder.Path("mine/session.toml"));
  EXPECT_EQ(bad.status, 1);
  EXPECT_THAT(bad.output, AllOf(HasSubstr("bad   v00_A.png"), HasSubstr("fill in exposure_s"),
                                HasSubstr("nothing fixes the absolute scale")));
}

// The tags in photos of a room leave corners of the lens unseen: `run` would say so after minutes.
TEST(DoctorTest, CalibratesACameraWithoutIntrinsicsAsRunDoes) {
  const support::OfficeCopy office;
  office.Replace("office/session.toml", "intrinsics = \"cam0.yaml\"\n", "");
  const support::ProgramRun doctor = support::RunProgram("doctor " + office.Path("office/session.toml"));
  EXPECT_EQ(doctor.status, 1);
  EXPECT_THAT(doctor.output,
              AllOf(HasSubstr("bad   cam0: no corner in the upper"), HasSubstr("views are placed by tags")));
}

// A misspelt board, or the wrong folder: what is wrong with all images is said once.
TEST(CalibrateCommand, ImagesWithoutABoardAreOneWarning) {
  const TempFolder folder;
  const std::string out =
      support::RunProgram("calibrate " + kOffice + "/photos/v00_*.png --board chessboard:9x6:0.025 -o " +
                          folder.Path("out"))
          .output;
  EXPECT_THAT(out, HasSubstr("warning: 6 of 6 images (v00_A.png, v00_B.png, v00_C.png, ...): no chessboard"));
  EXPECT_EQ(out.find("warning: "), out.rfind("warning: ")) << out;
}

// Codes that the sources give to warnings, by the ways in which they do.
std::set<std::string> WarningCodesOfSources() {
  const std::regex after_push(
      R"((?:(?:warnings|notes)\.push_back|AddUndetermined)\(\s*\{\s*(?:[a-z.]+,\s*|"",\s*|-1,\s*|id,\s*)*"([a-z_]+)\")");
  std::set<std::string> codes;
  for (const char* layer : {"apps", "inverse", "calib"}) {
    const fs::path folder = fs::path(LUXFIT_FIXTURES).parent_path() / layer;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
      if (entry.path().extension() != ".cc") continue;
      std::ifstream file(entry.path());
      const std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
      for (std::sregex_iterator at(text.begin(), text.end(), after_push), end; at != end; ++at)
        codes.insert((*at)[1]);
    }
  }
  return codes;
}

TEST(ExplainTest, KnowsEveryWarning) {
  const std::set<std::string> codes = WarningCodesOfSources();
  EXPECT_GT(codes.size(), 40U) << "the expression finds too few";
  for (const std::string& code : codes) {
    EXPECT_THAT(ExplainedWarnings(), Contains(code));
    EXPECT_THAT(ExplanationOf(code), HasSubstr("Fix: ")) << code;
  }
}

TEST(ExplainTest, KnowsKeysAndSuggests) {
  EXPECT_THAT(support::RunProgram("explain camera.response").output, HasSubstr("linear"));
  const support::ProgramRun typo = support::RunProgram("explain camera.respons");
  EXPECT_EQ(typo.status, 2);
  EXPECT_THAT(typo.output, HasSubstr("did you mean \"camera.response\"?"));
}

TEST(HelpTest, EveryCommandShowsAnExampleOfItself) {
  const std::vector<std::string> commands = CommandsOfHelp();
  EXPECT_GT(commands.size(), 15U);
  for (const std::string& command : commands) {
    const support::ProgramRun help = support::RunProgram(command + " --help");
    EXPECT_EQ(help.status, 0);
    EXPECT_THAT(help.output, AllOf(HasSubstr("Example:"), HasSubstr("luxfit " + command))) << command;
  }
}

TEST(HelpTest, IsACommandToo) {
  EXPECT_EQ(support::RunProgram("help run").output, support::RunProgram("run --help").output);
  EXPECT_EQ(support::RunProgram("help").output, support::RunProgram("--help").output);
  const support::ProgramRun misspelt = support::RunProgram("help rum");
  EXPECT_EQ(misspelt.status, 2);
  EXPECT_THAT(misspelt.output, HasSubstr("did you mean \"run\"?"));
}

TEST(ExplainTest, KnowsWholeSections) {
  const support::ProgramRun states = support::RunProgram("explain states");
  EXPECT_EQ(states.status, 0);
  EXPECT_THAT(states.output, HasSubstr("states.all: all = {"));
  EXPECT_THAT(support::RunProgram("explain luxmeter").output,
              AllOf(HasSubstr("luxmeter.readings: "), HasSubstr("luxmeter.scale: ")));
}

TEST(HelpTest, SuggestsCommandsAndOptions) {
  const support::ProgramRun command = support::RunProgram("simulat x -o y");
  EXPECT_EQ(command.status, 2);
  EXPECT_THAT(command.output, HasSubstr("did you mean \"simulate\"?"));
  const support::ProgramRun option = support::RunProgram("run x -o y --jsn");
  EXPECT_EQ(option.status, 2);
  EXPECT_THAT(option.output, HasSubstr("did you mean \"--json\"?"));
}

TEST(ShellTest, BashCompletes) {
  const TempFolder folder;
  folder.Write("luxfit.bash", support::RunProgram("completion bash").output);
  folder.Write("try.bash",
               "source " + folder.Path("luxfit.bash") +
                   "\nCOMP_WORDS=(luxfit regis); COMP_CWORD=1; _luxfit; echo \"${COMPREPLY[@]}\"\n"
                   "COMP_WORDS=(luxfit run --dry); COMP_CWORD=2; _luxfit; echo \"${COMPREPLY[@]}\"\n");
  const int status =
      std::system(("bash " + folder.Path("try.bash") + " >" + folder.Path("out") + " 2>&1").c_str());
  EXPECT_EQ(status, 0);
  EXPECT_EQ(folder.Read("out"), "register\n--dry-run\n");
}

TEST(ShellTest, ZshReadsItsScript) {
  if (std::system("command -v zsh >/dev/null") != 0) GTEST_SKIP() << "zsh is not installed";
  const TempFolder folder;
  folder.Write("_luxfit", support::RunProgram("completion zsh").output);
  EXPECT_EQ(std::system(("zsh -n " + folder.Path("_luxfit")).c_str()), 0);
}

TEST(ShellTest, ManualPagesOfAllCommands) {
  const TempFolder folder;
  EXPECT_EQ(support::RunProgram("man -o " + folder.Path("man")).status, 0);
  for (const std::string& command : CommandsOfHelp())
    EXPECT_THAT(folder.Read("man/luxfit-" + command + ".1"),
                AllOf(HasSubstr(".SH EXAMPLE"), HasSubstr(".SH EXIT STATUS")))
        << command;
  EXPECT_THAT(folder.Read("man/luxfit.1"), HasSubstr("luxfit\\-run (1)"));
}

}  // namespace
}  // namespace luxfit
