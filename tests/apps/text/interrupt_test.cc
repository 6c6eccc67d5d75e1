#include "apps/text/interrupt.h"

#include <gtest/gtest.h>

namespace luxfit {
namespace {

TEST(InterruptTest, TheFirstIsAWishAndTheSecondEndsTheProgram) {
  for (const int wish : {SIGINT, SIGTERM}) {
    ASSERT_EXIT(
        {
          const InterruptListener listener;
          if (InterruptListener::WasInterrupted()) _exit(1);
          raise(wish);
          if (!InterruptListener::WasInterrupted()) _exit(2);
          raise(wish);
          _exit(3);
        },
        testing::KilledBySignal(wish), "the same signal again");
  }
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
