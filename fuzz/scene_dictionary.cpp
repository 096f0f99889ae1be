// Prints libFuzzer's dictionary of scenes: the tokens of TOML, and every key, table and choice of the key table.
#include <cstdio>
#include <iterator>
#include <set>
#include <string>

#include "core/scene/keys.hpp"
#include "core/scene/renamed_keys.hpp"

namespace {

// in the notation of libFuzzer
constexpr const char* toml[] = {R"(\x0a)",    "=",        "[",           "]",          "[[",         "]]",
                                "{",          "}",        ", ",          ".",          R"(\")",      R"(\\)",
                                R"(\"\"\")",  "'''",      "#",           "true",       "false",      "nan",
                                "inf",        "-",        "1e308",       "1e9",        "1e12",       "1e-13",
                                "1e400",      "4.9e-324", "0x",          "0b1",        "1979-05-27", R"(\xef\xbb\xbf)",
                                R"(\xff)",    R"(\x00)",  R"(\x0d\x0a)", R"(\\u0000)", "[[[[[[",     R"(\"A\")",
                                R"(\"rock\")"};

}  // namespace

int main() {
  using voussoir::KeyType;
  std::set<std::string> words(std::begin(toml), std::end(toml));
  for (const voussoir::KeyRow& row : voussoir::key_rows()) {
    const std::string key(row.key);
    words.insert(key + " = ");
    if (row.table.empty() && row.type == KeyType::table) words.insert("[" + key + R"(]\x0a)");
    if (row.table.empty() && row.type == KeyType::tables) words.insert("[[" + key + R"(]]\x0a)");
    for (const std::string_view choice : row.choices)
      words.insert(R"(\")" + std::string(choice) + R"(\")");
  }
  for (const voussoir::RenamedKey& row : voussoir::renamed_keys)
    words.insert(std::string(row.earlier.substr(row.earlier.rfind('.') + 1)) + " = ");
  for (const std::string& word : words)
    std::printf("\"%s\"\n", word.c_str());
}
