# Writes OUTPUT, a source that holds the page's text, style and program as string literals.
# cmake -DHTML=... -DPROGRAM=... -DCSS=... -DSCRIPT=... -DOUTPUT=... -P embed.cmake
function(literal path variable)
  file(READ "${path}" text)
  string(LENGTH "${text}" length)
  set(pieces "")
  set(at 0)
  # Compilers promise 65536 characters a literal; neighbours are joined.
  while(at LESS length)
    string(SUBSTRING "${text}" ${at} 8000 piece)
    string(APPEND pieces "R\"luxfit~(${piece})luxfit~\"\n")
    math(EXPR at "${at} + 8000")
  endwhile()
  set(${variable} "${pieces}" PARENT_SCOPE)
endfunction()

literal("${HTML}" html)
literal("${PROGRAM}" program)
literal("${CSS}" css)
literal("${SCRIPT}" script)
file(WRITE "${OUTPUT}" "// Made by apps/report/embed.cmake.
#include \"apps/report/report_page.h\"

namespace luxfit {

ReportAssets GetReportAssets() {
  static constexpr char kHtml[] =\n${html};
  static constexpr char kProgram[] =\n${program};
  static constexpr char kCss[] =\n${css};
  static constexpr char kScript[] =\n${script};
  return {{kHtml, sizeof kHtml - 1}, {kProgram, sizeof kProgram - 1}, {kCss, sizeof kCss - 1}, {kScript, sizeof kScript - 1}};
}

}  // namespace luxfit
")
