// A random generator seeded by the running test's name: tests do not disturb each other's numbers, and
// repeat.
#ifndef LUXFIT_TESTS_SUPPORT_TEST_RNG_H_
#define LUXFIT_TESTS_SUPPORT_TEST_RNG_H_

#include <gtest/gtest.h>

#include <cstdint>
#include <random>
#include <string>

namespace luxfit::support {

inline std::mt19937_64 TestRng() {
  const testing::TestInfo* const info = testing::UnitTest::GetInstance()->current_test_info();
  const std::string name = std::string(info->test_suite_name()) + "." + info->name();
  std::uint64_t hash = 14695981039346656037ull;  // FNV-1a: the same on every machine, unlike std::hash
  for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ull;
  return std::mt19937_64(hash);
}

}  // namespace luxfit::support

#endif  // LUXFIT_TESTS_SUPPORT_TEST_RNG_H_
