// compare_with_truth RESULT_JSON TRUTH_JSON: true beside fitted values of a rendered room.
#include <cstdio>
#include <exception>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/support/truth_comparison.h"

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: compare_with_truth RESULT_JSON TRUTH_JSON\n");
    return 2;
  }
  try {
    std::ifstream result(argv[1]), truth(argv[2]);
    std::fputs(luxfit::TruthTable(nlohmann::json::parse(result), nlohmann::json::parse(truth)).c_str(),
               stdout);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "compare_with_truth: %s\n", e.what());
    return 2;
  }
  return 0;
}
