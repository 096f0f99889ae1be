#pragma once

#include <gtest/gtest.h>

#include <string>

#include "text/file_fault.hpp"

namespace voussoir {

template <class Read>
void expect_fault(const Read& read, int line, int column, const std::string& part) {
  SCOPED_TRACE(part);
  try {
    read();
    ADD_FAILURE() << "read without an error";
  } catch (const FileFault& fault) {
    EXPECT_EQ(fault.line, line) << fault.what();
    EXPECT_EQ(fault.column, column) << fault.what();
    EXPECT_NE(std::string(fault.what()).find(part), std::string::npos) << fault.what();
  }
}

}  // namespace voussoir
