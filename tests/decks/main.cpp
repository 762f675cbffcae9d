// Decks are run as the program runs them: threads wait without spinning, BLAS with the kernels the program would take.
#include <gtest/gtest.h>

#include "deck/deck.hpp"

int main(int argc, char** argv) {
  dygita::prepare_process(argv);
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
