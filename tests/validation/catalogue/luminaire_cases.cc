#include "tests/validation/catalogue/catalogue_case.h"
#include "tests/validation/catalogue/session_edits.h"

namespace luxfit {
namespace {

using support::OfficeCopy;

constexpr char kGroup[] = "luminaires";

void Given(const OfficeCopy& office, const std::string& luminaire) {
  office.Write("office/session.toml", office.Read("office/session.toml") + "\n[[luminaire]]\n" + luminaire);
}

}  // namespace

std::vector<CatalogueCase> LuminaireCases() {
  return {
      {kGroup,
       "a luminaire that nothing lights",
       Required::kNamed,
       {"luminaire_undetermined", "luminaire_named_once", "states_as_if"},
       [](const OfficeCopy& office) {
         office.Replace("office/session.toml", "all = { A = 1.0,", "all = { E = 1.0, A = 1.0,");
       }},
      {kGroup,
       "all on together only, their number unknown",
       Required::kSolved,
       {},
       [](const OfficeCopy& office) {
         office.KeepPhotos([](auto&, auto& state) { return state == "all"; });
         office.ChangeRows("office/luxmeter.csv", [](const Fields& row) { return row[7] == "all"; });
         std::string session = office.Read("office/session.toml");
         session.erase(session.find("[states]"), session.find("[luxmeter]") - session.find("[states]"));
         office.Write("office/session.toml", session + "\n[luminaires]\ncount = \"estimate\"\n");
       }},
      {kGroup,
       "a luminaire given 0.5 m off, as sure",
       Required::kNamed,
       {"given_contradicted"},
       [](const OfficeCopy& office) {
         Given(office, "id = \"A\"\nposition_m = [2.0, 2.0, 2.79]\nposition_sigma_m = 0.01\n");
       }},
      {kGroup,
       "a luminaire given outside the room",
       Required::kNamed,
       {"luminaire_outside"},
       [](const OfficeCopy& office) {
         Given(office, "id = \"A\"\nposition_m = [1.5, 2.0, 3.4]\nposition_sigma_m = 0.05\n");
       }},
      {kGroup,
       "a flux given twice too high",
       Required::kNamed,
       {"given_contradicted"},
       [](const OfficeCopy& office) { Given(office, "id = \"A\"\nflux_lm = 7200\nflux_sigma_lm = 50\n"); }},
      {kGroup,
       "only one view",
       Required::kNamed,
       {"one_view"},
       [](const OfficeCopy& office) { office.KeepPhotos([](auto& view, auto&) { return view == "v03"; }); }},
      {kGroup,
       "only two views",
       Required::kSolved,
       {},
       [](const OfficeCopy& office) {
         office.KeepPhotos([](auto& view, auto&) { return view == "v00" || view == "v05"; });
       }},
  };
}

}  // namespace luxfit
