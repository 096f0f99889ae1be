// From a scene file to the input of a simulation, and texts made from a scene.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/model/prepared.hpp"
#include "core/scene/scene_spec.hpp"

namespace voussoir {

// Reads and checks a scene. Overrides are "key=value", applied in order. Throws SceneError (bad input, or a file that
// cannot be read).
Scene read_scene(const std::filesystem::path& file, const std::vector<std::string>& overrides = {});

// the same for a text; `name` replaces the file in errors
Scene parse_scene(std::string_view text, const std::string& name, const std::vector<std::string>& overrides = {});

// The same for a tree that does not come from a text, whose values know their places. Files that it names are in the
// folder of `name`, or in the working directory.
Scene read_tree(Node tree, const std::string& name, const std::vector<std::string>& overrides = {});

// Cuts the domain, builds bodies, assigns properties, resolves selectors and monitors. Throws SceneError if the scene
// is inconsistent. Dim must be scene.dimension.
template <int Dim>
Prepared<Dim> prepare(const Scene& scene);

// The effective scene as canonical text, to be hashed: independent of comments, layout, the order of keys, how numbers
// are written, of earlier or present names of keys, and of whether a value came from the file or an override. Unstated
// defaults do not appear.
std::string canonical_text(const Scene& scene);

// the input hash: the fingerprint of that text
std::string input_hash(const Scene& scene);

// the same text of a part of a scene
std::string canonical_text(const Node& part);

// every key, its meaning, unit, range and default, in markdown, from the table that the reader uses
std::string scene_documentation();

}  // namespace voussoir
