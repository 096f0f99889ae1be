// The results of `voussoir modes`: text, modes.json, and the shapes for ParaView and the viewer.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/base/run_scene.hpp"
#include "core/modes/modes.hpp"

namespace voussoir {

// results doubtful or unusual, one line each: modes that leave the state, joints at their strength, blocks that hang
// free, faces that act at one point, a tangent that is not symmetric
template <int Dim>
std::vector<std::string> doubts_of(const Modes<Dim>& modes, const Model<Dim>& model);

// the table of the modes
template <int Dim>
std::string modes_text(const Modes<Dim>& modes, const Model<Dim>& model);

template <int Dim>
std::string modes_json(const Modes<Dim>& modes, const Model<Dim>& model, const LoadedScene& scene);

// mode_01.vtp … for ParaView, each the blocks moved along a mode by a twentieth of the model's size, and modes.pvd,
// whose time is the mode's number
std::vector<std::string> mode_files(int number);

// These files, with `view` also view.bin and view.html, in which each mode is a stage of sixteen frames, one swing;
// last modes.json. Throws OutputError.
template <int Dim>
void write_modes(const Modes<Dim>& modes, const Model<Dim>& model, const State<Dim>& rest, const Prepared<Dim>& scene,
                 const std::string& json, bool view, const std::filesystem::path& folder);

}  // namespace voussoir
