// A scene in space as text for another program: its blocks as they are before the first stage, the joints between them,
// their properties. Neither program was available to run the texts, and the texts state this.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/model/prepared.hpp"
#include "core/scene/scene_spec.hpp"

namespace voussoir {

// the contents of both programs' texts
struct ExportedScene {
  const Model<3>* model = nullptr;
  std::string title;                  // of the scene, or its file
  std::vector<int> joints;            // that cut blocks and may open, ascending
  std::vector<int> properties;        // of contacts, the most common of the joints' first
  std::vector<std::string> left_out;  // features of the scene that the text leaves out, one line each
};

// Throws SceneError, in one line, at features without which the model would differ and that no such text can express:
// water, bolts, potential particles, joint laws other than linear with constant friction.
ExportedScene exported(const Scene& scene, const Prepared<3>& prepared, std::string_view program);

// first lines of the text, each after `comment`: the program that wrote it, whether it was run, units, features left
// out
std::string export_head(const ExportedScene& scene, std::string_view program, std::string_view comment,
                        std::string_view run);

// a data file of 3DEC 7; blocks are polyhedra by their faces
std::string three_dec_text(const ExportedScene& scene);

// a Python script for YADE built with its PotentialBlock; blocks are half-spaces. Throws BadInput at more than one set
// of joint properties, and at strength in tension and cohesion.
std::string yade_text(const ExportedScene& scene);

}  // namespace voussoir
