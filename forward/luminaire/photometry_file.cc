#include "forward/luminaire/photometry_file.h"

#include <cctype>
#include <filesystem>
#include <stdexcept>

#include "forward/luminaire/internal/ies_file.h"
#include "forward/luminaire/internal/ldt_file.h"
#include "forward/luminaire/internal/photometry_text.h"

namespace luxfit {
namespace {

bool IsIes(const std::string& name) {
  std::string extension = std::filesystem::path(name).extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (extension != ".ies" && extension != ".ldt")
    throw std::runtime_error(name +
                             ": expected a photometric file .ies (IES LM-63) or .ldt (EULUMDAT), got \"" +
                             extension + "\"; convert it, or rename it if it is one of these");
  return extension == ".ies";
}

}  // namespace

PhotometryFile ReadPhotometry(const std::string& path) {
  return IsIes(path) ? PhotometryOf(ReadIes(path)) : PhotometryOf(ReadLdt(path));
}

PhotometryFile ParsePhotometry(const std::string& text, const std::string& name) {
  return IsIes(name) ? PhotometryOf(ParseIes(text, name)) : PhotometryOf(ParseLdt(text, name));
}

}  // namespace luxfit
