// The table of all keys of a study: the reader refuses others, and page and schema follow from it.
#pragma once

#include <span>
#include <string_view>

namespace voussoir {

enum class StudyValue {
  text,
  number,
  boolean,
  choice,          // one of StudyKey::words
  choice_or_text,  // one of them, or another text that `otherwise` describes
  texts,           // a list of texts
  values,          // a list of values of a scene's key
  lists,           // a list of lists
  table,
  tables  // [[key]]: a list of tables
};

struct StudyKey {
  std::string_view table{}, key{};  // table "": the top of the file
  StudyValue type = StudyValue::text;
  bool required = false;
  std::string_view words{};  // "a|b"
  std::string_view otherwise{};
  std::string_view meaning{};
};

std::span<const StudyKey> study_keys();

// the group of keys of the tables at a key, as `table` of their rows: "grid.keys", "with"
std::string_view tables_at(const StudyKey& key);

}  // namespace voussoir
