#include <gtest/gtest.h>

#include "base/error.hpp"

namespace dygita {

TEST(InputError, opens_with_file_and_line) {
  EXPECT_STREQ(InputError(Origin{"crush.lua", 18}, "material.elastic: no name").what(),
               "crush.lua:18: material.elastic: no name");
}

TEST(InputError, opens_with_its_text_when_it_comes_from_no_deck) {
  EXPECT_STREQ(InputError(Origin{}, "no name").what(), "no name");
}

TEST(Check, passes_when_the_condition_holds) { EXPECT_NO_THROW(CHECK(1 + 1 == 2, "arithmetic")); }

TEST(Check, names_the_condition_the_place_and_asks_for_a_report) {
  try {
    CHECK(1 + 1 == 3, "the sum is wrong");
    FAIL() << "CHECK let a false condition pass";
  } catch (const ContractError& error) {
    const std::string message = error.what();
    EXPECT_EQ(message.find("internal error: the sum is wrong (1 + 1 == 3, "), 0U) << message;
    EXPECT_NE(message.find("test_error.cpp:"), std::string::npos) << message;
    EXPECT_NE(message.find("please report it"), std::string::npos) << message;
  }
}

TEST(Errors, are_not_mistaken_for_one_another) {
  EXPECT_THROW(throw InputError("deck"), std::runtime_error);
  EXPECT_FALSE((std::is_base_of_v<InputError, NumericalError>));
  EXPECT_FALSE((std::is_base_of_v<std::runtime_error, ContractError>));
}

}  // namespace dygita
