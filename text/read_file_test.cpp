// Files are read completely or refused, immediately and without taking memory.
#include "text/read_file.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>

namespace voussoir::read_file_test {
namespace {

namespace fs = std::filesystem;

class ReadFile : public ::testing::Test {
 protected:
  ReadFile() { fs::create_directories(folder_); }
  ~ReadFile() override { fs::remove_all(folder_); }

  void expect_fault(const fs::path& file, const std::string& part) const {
    try {
      read_file(file, 100);
      ADD_FAILURE() << file;
    } catch (const ReadFault& fault) {
      EXPECT_NE(std::string(fault.what()).find(part), std::string::npos) << file << fault.what();
    }
  }
  const fs::path folder_ = fs::temp_directory_path() / ("voussoir_read_file_" + std::to_string(::getpid()));
};

TEST_F(ReadFile, IsCompleteOrRefused) {
  const std::string content("a\0b\r\n", 5);
  std::ofstream(folder_ / "file", std::ios::binary) << content;
  EXPECT_EQ(read_file(folder_ / "file", 5), content);
  EXPECT_THROW(read_file(folder_ / "file", 4), ReadFault);
  std::uintmax_t size = 0;
  EXPECT_EQ(read_head(folder_ / "file", 2, size), content.substr(0, 2));
  EXPECT_EQ(size, 5u);
}

TEST_F(ReadFile, OnlyRegularFilesOfSaneSize) {
  ASSERT_EQ(::mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  std::ofstream(folder_ / "sparse").close();
  fs::resize_file(folder_ / "sparse", std::uintmax_t{20} << 30);
  fs::create_symlink("circle", folder_ / "circle");
  expect_fault(folder_ / "pipe", "a pipe");
  expect_fault("/dev/zero", "a device");
  expect_fault(folder_, "a folder");
  expect_fault(folder_ / "sparse", "larger than");
  expect_fault(folder_ / "none", "no such file");
  expect_fault(folder_ / "circle", "no such file");
  expect_fault(folder_ / "sparse/below", "no such file");
}

}  // namespace
}  // namespace voussoir::read_file_test
