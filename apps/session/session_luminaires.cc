#include "apps/session/session_luminaires.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>

#include "apps/session/internal/session_groups.h"
#include "apps/session/internal/session_states.h"
#include "apps/session/session_files.h"
#include "apps/text/suggest.h"
#include "forward/luminaire/distribution_ops.h"

namespace luxfit {
namespace {

// Returns how many lengths a shape has: one for the diameter of a disc or sphere; two for a rectangle, along
// the heading and across it.
const std::map<std::string, size_t>& LengthsOfShape() {
  static const std::map<std::string, size_t> lengths{
      {"point", 0}, {"disc", 1}, {"rectangle", 2}, {"sphere", 1}};
  return lengths;
}

bool IsPhotometricFile(const std::string& text) {
  const std::string extension = ExtensionOf(text);
  return extension == ".ies" || extension == ".ldt";
}

std::vector<double> ReadSize(const TomlCursor& value) {
  std::vector<double> size_m;
  if (!value.IsArray()) return {value.NumberAbove(0, "m")};
  for (const TomlCursor& length : value.Elements("lengths")) size_m.push_back(length.NumberAbove(0, "m"));
  return size_m;
}

std::optional<std::string> ReadShape(const TomlCursor& table, size_t lengths_given) {
  const auto shape = table.Find("shape");
  const auto size = table.Find("size_m");
  if (!shape) {
    if (size && lengths_given != 1 && lengths_given != 2)
      throw size->Error("expected one or two lengths, got " + size->Shown() +
                        "; write [0.6, 0.6] for a rectangle");
    return std::nullopt;
  }
  const std::string name = shape->OneOf({"point", "disc", "rectangle", "sphere"});
  const size_t expected = LengthsOfShape().at(name);
  if (!size || lengths_given == expected) return name;
  const std::string lengths = expected == 0   ? "no size"
                              : expected == 1 ? "one length, the diameter"
                                              : "two lengths";
  throw size->Error("expected " + lengths + " for shape " + shape->Shown() + ", got " + size->Shown() +
                    (expected == 0 ? "; remove the key or change the shape"
                                   : "; write " + std::string(expected == 1 ? "[0.2]" : "[0.6, 0.6]")));
}

// Reads a sigma, which has no meaning without its value.
std::optional<double> ReadSigma(const TomlCursor& table, const std::string& key, const std::string& value_key,
                                const std::string& unit) {
  const auto sigma = table.Find(key);
  if (!sigma) return std::nullopt;
  if (!table.Find(value_key))
    throw sigma->Error("expected " + value_key + " beside it, got none; add " + value_key +
                       " or remove the sigma");
  return sigma->NumberAtLeast(0, unit);
}

std::vector<double> ReadNumbers(const TomlCursor& list, const std::string& what) {
  std::vector<double> numbers;
  for (const TomlCursor& element : list.Elements(what)) numbers.push_back(element.NumberAtLeast(0, ""));
  return numbers;
}

// Checks a key that only some distributions have.
void ExpectBeside(const TomlCursor& key, const SessionLuminaire& luminaire,
                  bool (*has_it)(const DistributionOps&)) {
  const DistributionOps* const ops = FindDistribution(luminaire.photometry);
  if (ops != nullptr && has_it(*ops)) return;
  throw key.Error("expected it beside photometry = " + ListQuoted(PhotometryNames(has_it)) +
                  " only, got photometry = " + Quoted(luminaire.photometry) + "; remove one of them");
}

// Reads the nodes of photometry = "table": both lists, or none where they are to be estimated.
void ReadTable(const TomlCursor& table, SessionLuminaire& luminaire) {
  const auto gamma = table.Find("gamma_deg"), intensity = table.Find("cd_per_klm");
  if (!gamma && !intensity) return;
  const TomlCursor& given = gamma ? *gamma : *intensity;
  ExpectBeside(given, luminaire, [](const DistributionOps& ops) { return ops.has_table; });
  if (!gamma || !intensity)
    throw given.Error(
        "expected gamma_deg and cd_per_klm together, got one of them; add the other, or remove it to have "
        "the "
        "table estimated");
  luminaire.gamma_deg = ReadNumbers(*gamma, "a list of angles from the aim");
  luminaire.cd_per_klm = ReadNumbers(*intensity, "a list of intensities");
  const bool rising =
      std::adjacent_find(luminaire.gamma_deg.begin(), luminaire.gamma_deg.end(),
                         [](double a, double b) { return b <= a; }) == luminaire.gamma_deg.end();
  if (luminaire.gamma_deg.size() < 2 || !rising || luminaire.gamma_deg.back() > 180)
    throw gamma->Error("expected two angles or more that rise from 0 to at most 180, got " + gamma->Shown() +
                       "; sort them");
  if (luminaire.cd_per_klm.size() != luminaire.gamma_deg.size())
    throw intensity->Error("expected one intensity an angle, " + std::to_string(luminaire.gamma_deg.size()) +
                           ", got " + std::to_string(luminaire.cd_per_klm.size()) +
                           "; give both lists the same length");
  if (*std::max_element(luminaire.cd_per_klm.begin(), luminaire.cd_per_klm.end()) <= 0)
    throw intensity->Error("expected an intensity above 0, got none; correct them");
}

// Reads rows of cells: each row runs along the heading, and the rows follow one another across it.
Eigen::ArrayXXd ReadEmission(const TomlCursor& emission, const SessionLuminaire& luminaire) {
  if (luminaire.shape.value_or("") != "rectangle")
    throw emission.Error("expected it beside shape = \"rectangle\" only; add the shape, or remove the key");
  std::vector<std::vector<double>> rows;
  for (const TomlCursor& row : emission.Elements("a list of rows of cells such as [[1, 2], [1, 0]]"))
    rows.push_back(ReadNumbers(row, "a row of cells"));
  Eigen::ArrayXXd cells = Eigen::ArrayXXd::Zero(static_cast<Eigen::Index>(rows.empty() ? 0 : rows[0].size()),
                                                static_cast<Eigen::Index>(rows.size()));
  for (size_t j = 0; j < rows.size(); ++j) {
    if (rows[j].size() != rows[0].size())
      throw emission.Error("expected rows of one length, got " + emission.Shown() + "; fill them up with 0");
    for (size_t i = 0; i < rows[j].size(); ++i)
      cells(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = rows[j][i];
  }
  if (!(cells.sum() > 0))
    throw emission.Error("expected a share above 0, got " + emission.Shown() + "; correct it");
  return cells / cells.sum();
}

SessionLuminaire ReadLuminaire(const TomlCursor& table, const std::string& folder) {
  table.ExpectKeys({"id", "photometry", "cosine_exponent", "gamma_deg", "cd_per_klm", "emission", "shape",
                    "size_m", "position_m", "position_sigma_m", "aim", "heading", "flux_lm",
                    "flux_sigma_lm"});
  SessionLuminaire luminaire;
  luminaire.line = table.place().line;
  if (const auto photometry = table.Find("photometry")) {
    luminaire.photometry = photometry->Text("a distribution");
    if (IsPhotometricFile(luminaire.photometry)) {
      luminaire.photometry_path = AbsolutePath(FindFile(*photometry, folder));
    } else {
      std::vector<std::string> names = PhotometryNames();
      names.insert(names.begin(), "auto");
      photometry->OneOf(names);
    }
  }
  if (const auto exponent = table.Find("cosine_exponent")) {
    ExpectBeside(*exponent, luminaire, [](const DistributionOps& ops) { return ops.has_exponent; });
    luminaire.cosine_exponent = exponent->NumberAbove(0, "");
  }
  ReadTable(table, luminaire);
  if (const auto size = table.Find("size_m")) luminaire.size_m = ReadSize(*size);
  luminaire.shape = ReadShape(table, luminaire.size_m.size());
  if (const auto emission = table.Find("emission")) luminaire.emission = ReadEmission(*emission, luminaire);
  if (const auto position = table.Find("position_m"))
    luminaire.position_m = position->Vector("a point [x, y, z]");
  luminaire.position_sigma_m = ReadSigma(table, "position_sigma_m", "position_m", "m; 0: fixed");
  if (const auto aim = table.Find("aim")) luminaire.aim = aim->Direction("a direction [x, y, z]");
  if (const auto heading = table.Find("heading")) {
    luminaire.heading = heading->Direction("a direction [x, y, z]");
    const Eigen::Vector3d aim = luminaire.aim.value_or(Eigen::Vector3d(0, 0, -1));
    if (luminaire.heading->cross(aim).norm() < 1e-3)
      throw heading->Error("expected a direction across the aim, got " + heading->Shown() +
                           ", which is along it; give the direction of the C0 half-plane");
  }
  if (const auto flux = table.Find("flux_lm")) luminaire.flux_lm = flux->NumberAbove(0, "lm");
  luminaire.flux_sigma_lm = ReadSigma(table, "flux_sigma_lm", "flux_lm", "lm; 0: fixed");
  return luminaire;
}

// Reads how many luminaires there are; only a session without [states] may leave the number open.
void ReadCount(const TomlCursor& session, NamedLuminaires& named) {
  const auto known = static_cast<int>(named.luminaires.size());
  const bool has_states = session.Find("states").has_value();
  named.count = known;
  named.count_is_estimated = !has_states && known == 0;
  const auto section = session.Find("luminaires");
  if (!section) return;
  section->ExpectKeys({"count", "max"});
  if (const auto most = section->Find("max")) {
    named.max = most->WholeNumber("a number of luminaires");
    if (named.max < std::max(1, known))
      throw most->Error("expected at least the " + std::to_string(known) +
                        " luminaires that are named, got " + most->Shown() + "; raise it or remove the key");
  }
  const auto count = section->Find("count");
  if (!count) return;
  if (count->IsText()) {
    count->OneOf({"estimate"});
    if (has_states)
      throw count->Error(
          "expected the number of luminaires that [states] names, or nothing, got \"estimate\"; " +
          std::string("a number is estimated only without [states], where all are on"));
    named.count_is_estimated = true;
    return;
  }
  const bool has_open_groups =
      std::any_of(named.groups.begin(), named.groups.end(),
                  [](const SessionGroup& group) { return group.count_is_estimated; });
  if (has_open_groups)
    throw count->Error("expected nothing beside a group whose number is to be estimated, got " +
                       count->Shown() + "; remove the key");
  named.count = count->WholeNumber("\"estimate\" or a number of luminaires");
  named.count_is_estimated = false;
  if (has_states ? named.count != known : named.count < std::max(1, known))
    throw count->Error("expected " + std::string(has_states ? "" : "at least ") + std::to_string(known) +
                       ", the number of luminaires that [states] and [[luminaire]] name, got " +
                       count->Shown() + "; name the others, or remove the key");
}

}  // namespace

NamedLuminaires ReadLuminaires(const TomlCursor& session, const std::string& folder) {
  NamedLuminaires named;
  std::vector<std::string> ids;
  if (const auto list = session.Find("luminaire")) {
    const std::vector<TomlCursor> tables = list->Elements("a list of tables [[luminaire]]");
    for (const TomlCursor& table : tables) named.luminaires.push_back(ReadLuminaire(table, folder));
    ids = UniqueIds(tables);
    for (size_t i = 0; i < ids.size(); ++i) named.luminaires[i].id = ids[i];
  }
  const auto add = [&](const std::string& id) {
    if (std::find(ids.begin(), ids.end(), id) != ids.end()) return;
    ids.push_back(id);
    named.luminaires.emplace_back();
    named.luminaires.back().id = id;
  };
  named.groups = ReadGroups(session, ids);
  for (const SessionGroup& group : named.groups)
    std::for_each(group.luminaires.begin(), group.luminaires.end(), add);
  if (const auto states = session.Find("states")) {
    for (const std::string& id : LuminairesOfStates(*states, named.groups, ids)) add(id);
  }
  ReadCount(session, named);
  return named;
}

}  // namespace luxfit
