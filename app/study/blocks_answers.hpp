// Block theory's answers for many settings of one scene, in this process: what a sample of a million rows needs.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/base/run_scene.hpp"
#include "app/study/drawn_keys.hpp"
#include "core/key_blocks/block_survey.hpp"
#include "core/scene/scene.hpp"

namespace voussoir {

// no_block: every block is fixed, none forms. nothing_moves: all are stable or tapered, so that there is no factor.
enum class RowEnd { answered, no_block, nothing_moves, undecided, refused };

struct BlocksAnswer {
  RowEnd end = RowEnd::answered;
  std::optional<double> value;  // of the quantity
  std::string mode;             // the mechanism with the least factor: "slides on A, B"
  std::string message;          // why it was refused
};

// why there is no value
std::string status_text(const BlocksAnswer& answer);

// `voussoir blocks` for the values of some keys. If all of them are strengths that no law changes the blocks are cut
// once. May be called by several threads.
class BlocksAnswers {
 public:
  // Throws SceneError or BadInput if the scene as it is has no answer of this name, or options that are wrong.
  BlocksAnswers(const std::filesystem::path& scene, const std::vector<std::string>& overrides,
                const std::vector<std::string>& options, const std::string& quantity);

  // the keys and the joints that share a value, once before any answer
  void vary(const DrawnKeys& drawn);

  // `values` in the order of DrawnKeys::scene_keys; `row`: for keys that are drawn for each joint or set
  BlocksAnswer answer(const std::vector<double>& values, int row = 0) const;

  const std::string& unit() const { return unit_; }
  const std::string& divides() const { return divides_; }
  bool cuts_again() const { return strengths_.empty(); }  // for every row

 private:
  // a strength of joint properties
  struct Strength {
    std::string properties;
    bool friction = true;  // false: cohesion
  };

  template <int Dim>
  BlocksAnswer judge(Prepared<Dim> prepared, const std::vector<double>& values, int row) const;
  template <int Dim>
  void give_joints_their_own(Prepared<Dim>& prepared, int row) const;
  std::optional<Strength> strength_of(const std::string& key) const;

  std::filesystem::path file_;
  std::vector<std::string> overrides_;
  SurveyRequest request_;
  std::string quantity_, unit_ = "1", divides_;
  Node stated_;  // the file's tree
  std::shared_ptr<Scene> scene_;
  AnyPrepared prepared_;  // of the scene as it is
  const DrawnKeys* drawn_ = nullptr;
  std::vector<std::string> keys_;
  std::vector<Strength> strengths_;  // of keys_, if all are strengths; else empty
};

}  // namespace voussoir
