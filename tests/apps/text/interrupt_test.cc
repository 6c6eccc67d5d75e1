#include "apps/text/interrupt.h"

#include <gtest/gtest.h>

namespace luxfit {
namespace {

TEST(InterruptTest, TheFirstIsAWishAndTheSecondEndsTheProgram) {
  ASSERT_EXIT(
      {
        const InterruptListener listener;
        if (InterruptListener::WasInterrupted()) _exit(1);
        raise(SIGINT);
        if (!InterruptListener::WasInterrupted()) _exit(2);
        raise(SIGINT);
        _exit(3);
      },
      testing::KilledBySignal(SIGINT), "Ctrl-C again ends at once");
}

TEST(InterruptTest, ListensOnlyWhileItLives) {
  const auto handler = [] {
    struct sigaction now = {};
    sigaction(SIGINT, nullptr, &now);
    return now.sa_handler;
  };
  const auto before = handler();
  {
    const InterruptListener listener;
    EXPECT_NE(handler(), before);
    raise(SIGINT);
  }
  EXPECT_EQ(handler(), before);
  const InterruptListener again;
  EXPECT_FALSE(InterruptListener::WasInterrupted()) << "what an earlier one heard is over";
}

TEST(InterruptTest, WhatWasStartedDeafStaysDeaf) {
  ASSERT_EXIT(
      {
        signal(SIGINT, SIG_IGN);
        const InterruptListener listener;
        raise(SIGINT);
        _exit(InterruptListener::WasInterrupted() ? 1 : 0);
      },
      testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace luxfit
