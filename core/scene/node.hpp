// The tree of a scene file: its values and their places, before they are interpreted.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/scene/scene_error.hpp"
#include "text/plain_text.hpp"

namespace voussoir {

// The place of a value. An override has the file that it changes, but no line.
struct Place {
  std::shared_ptr<const std::string> source;
  int line = 0;
  std::shared_ptr<const std::string> override_text{};
};

struct Member;

struct Node {
  enum class Kind { boolean, integer, number, text, date, list, table };

  Kind kind = Kind::table;
  Place place;
  bool boolean = false;
  bool decimal = true;  // false: written as hexadecimal, octal or binary
  double number = 0;    // of integers too
  std::string text;
  std::vector<Node> items;      // of a list
  std::vector<Member> members;  // of a table, sorted by key

  bool is_number() const { return kind == Kind::integer || kind == Kind::number; }
  bool is_list_of_tables() const;  // of at least one table
  const Node* find(std::string_view key) const;
  Node* find(std::string_view key);
  Node& set(std::string_view key, Node value);
};

struct Member {
  std::string key;
  Node value;
};

// A table of the scene and its address in the form of `--set`, e.g. joints.A; empty for the whole scene.
struct Subject {
  const Node* node = nullptr;
  std::string path;
};

// a table inside a table, or the tables of a list, with their addresses; none if the file states none
std::optional<Subject> child(const Subject& table, std::string_view key);
std::vector<Subject> children(const Subject& table, std::string_view key);

// empty if it states none
std::string name_of(const Node& table);

// joints.A for a named table, joints.2 (counted from 1) for one without a name
std::string item_path(const std::string& list_path, const Node& item, std::size_t index);
std::string key_path(const std::string& table_path, std::string_view key);

// one line, at most about 60 characters
std::string value_text(const Node& node);
std::string place_text(const Place& place);

// "place: path = value: rule"; an absent key is reported as missing at its table's line
std::string complaint(const Node& node, const std::string& path, const std::string& rule);
std::string complaint(const Subject& table, std::string_view key, const std::string& rule);

// "place: message"
[[noreturn]] void refuse(const Place& place, const std::string& message, const std::string& key = {});

// throws the complaint as a SceneError
[[noreturn]] void refuse(const Node& node, const std::string& path, const std::string& rule);
[[noreturn]] void refuse(const Subject& table, std::string_view key, const std::string& rule);

// Refuses the first text or key of the tree that is not plain text (text/plain_text.hpp); `path` is the tree's address.
void require_plain_text(const Node& node, const std::string& path);

// the name most like a mistyped one, or an empty text when none is near
std::string nearest(std::string_view word, const std::vector<std::string>& candidates);

// "A, B, C", shortened when long; `none` when empty
std::string listed(const std::vector<std::string>& words, const std::string& none = "none");

// "did you mean 'A'? there are A, B"
std::string suggestion(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace voussoir
