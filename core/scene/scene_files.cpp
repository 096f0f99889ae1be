#include "core/scene/scene_files.hpp"

#include <algorithm>
#include <cctype>
#include <map>

#include "core/exchange/mesh.hpp"
#include "core/exchange/tables.hpp"
#include "core/scene/keys.hpp"
#include "core/scene/scene_text.hpp"

namespace voussoir {
namespace {

namespace fs = std::filesystem;

bool is_below(const fs::path& file, const fs::path& folder) {
  return std::mismatch(folder.begin(), folder.end(), file.begin(), file.end()).first == folder.end();
}

// a file of joints or blocks, and its tree
struct FileTree {
  std::shared_ptr<const std::string> name;
  int dimension;

  Node node(Node::Kind kind, int line) const {
    Node made;
    made.kind = kind;
    made.place = {name, line};
    return made;
  }
  Node number(double value, int line) const {
    Node made = node(Node::Kind::number, line);
    made.number = value;
    return made;
  }
  Node text(const std::string& value, int line) const {
    Node made = node(Node::Kind::text, line);
    made.text = value;
    return made;
  }
  template <class Numbers>
  Node numbers(const Numbers& values, int line) const {
    Node made = node(Node::Kind::list, line);
    for (const double value : values)
      made.items.push_back(number(value, line));
    return made;
  }
  Node points(const std::vector<std::vector<double>>& all, int line) const {
    Node made = node(Node::Kind::list, line);
    for (const std::vector<double>& point : all)
      made.items.push_back(numbers(point, line));
    return made;
  }
};

Node joint_tables(std::string_view text, const FileTree& source, const Node&, std::vector<FileRemark>& remarks) {
  Node list = source.node(Node::Kind::list, 1);
  for (const JointRow& row : read_joint_table(text, source.dimension, &remarks)) {
    Node joint = source.node(Node::Kind::table, row.line);
    joint.set("name", source.text(row.name, row.line));
    if (row.dip_deg) joint.set("dip", source.number(*row.dip_deg, row.line));
    if (row.dip_direction_deg) joint.set("dip_direction", source.number(*row.dip_direction_deg, row.line));
    if (!row.normal.empty()) joint.set("normal", source.numbers(row.normal, row.line));
    joint.set("point", source.numbers(row.point, row.line));
    if (!row.properties.empty()) joint.set("properties", source.text(row.properties, row.line));
    if (!row.set.empty()) joint.set("set", source.text(row.set, row.line));
    if (row.shape != OutlineForm::none) {
      const char* const sizes[] = {"length", "width"};
      joint.set("shape", source.text(shape_text(row.shape, source.dimension), row.line));
      for (std::size_t k = 0; k < row.extents.size(); ++k)
        joint.set(sizes[k], source.number(row.extents[k], row.line));
      if (row.shape == OutlineForm::polygon) joint.set("corners", source.points(row.corners, row.line));
    }
    list.items.push_back(std::move(joint));
  }
  return list;
}

// every part of a block is a table of its own; the first has the block's name
Node tables_of_planes(std::string_view text, const FileTree& source) {
  Node list = source.node(Node::Kind::list, 1);
  std::map<std::pair<std::string, int>, std::size_t> places;
  for (const PlaneRow& row : read_plane_table(text, source.dimension)) {
    const auto [at, added] = places.emplace(std::pair(row.block, row.part), list.items.size());
    if (added) {
      Node block = source.node(Node::Kind::table, row.line);
      const bool first = row.part == 0;
      block.set("name", source.text(first ? row.block : row.block + "-part-" + std::to_string(row.part), row.line));
      if (!first) block.set("part_of", source.text(row.block, row.line));
      block.set("planes", source.node(Node::Kind::list, row.line));
      list.items.push_back(std::move(block));
    }
    Node plane = source.node(Node::Kind::table, row.line);
    plane.set("normal", source.numbers(row.normal, row.line));
    plane.set("offset", source.number(row.offset, row.line));
    list.items[at->second].find("planes")->items.push_back(std::move(plane));
  }
  return list;
}

Node tables_of_meshes(const std::vector<Mesh>& meshes, const FileTree& source, std::vector<FileRemark>& remarks) {
  Node list = source.node(Node::Kind::list, 1);
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    const Mesh& mesh = meshes[i];
    Node block = source.node(Node::Kind::table, mesh.line);
    const std::string name = mesh.name.empty() ? "block-" + std::to_string(i + 1) : mesh.name;
    block.set("name", source.text(name, mesh.line));
    Node& corners = block.set("vertices", source.node(Node::Kind::list, mesh.line));
    for (const Vector<3>& corner : convex_corners(mesh, &remarks))
      corners.items.push_back(source.numbers(corner, mesh.line));
    list.items.push_back(std::move(block));
  }
  return list;
}

Node block_tables(const std::string& bytes, const FileTree& source, const Node& stated,
                  std::vector<FileRemark>& remarks) {
  std::string kind = fs::path(stated.text).extension().string();
  std::transform(kind.begin(), kind.end(), kind.begin(), [](unsigned char c) { return std::tolower(c); });
  if (kind == ".csv") return tables_of_planes(bytes, source);
  if (kind != ".stl" && kind != ".obj")
    refuse(stated, "blocks_file", "must end in .csv (planes of blocks), .stl or .obj, which determines the format");
  if (source.dimension == 2)
    refuse(stated, "blocks_file", "STL and OBJ contain 3-D blocks but dimension = 2; give a table of planes (.csv)");
  return tables_of_meshes(kind == ".stl" ? read_stl(bytes) : read_obj(bytes), source, remarks);
}

// a table under `key` read from the file that the scene names under `file_key`
template <class Read>
void add_tables(const Node& scene, const fs::path& folder, const char* file_key, const char* key, Node& tables,
                FilesRead& files, const Read& read) {
  const Node* stated = scene.find(file_key);
  if (!stated) return;
  const fs::path file = file_beside(*stated, file_key, folder);
  files.files.push_back(file);
  const std::string shown = (folder / fs::path(stated->text)).string();
  const FileTree source{std::make_shared<const std::string>(shown), scene_dimension(scene)};
  try {
    std::vector<FileRemark> remarks;
    tables.set(key, read(file_text(file), source, *stated, remarks));
    for (const FileRemark& remark : remarks)
      files.remarks.push_back(shown + (remark.line > 0 ? ":" + std::to_string(remark.line) : "") + ": " + remark.text);
  } catch (const FileFault& fault) {
    std::string place = shown;
    for (const int number : {fault.line, fault.column})
      if (number > 0) place += ":" + std::to_string(number);
    throw SceneError(place + ": " + fault.what(), printable(shown), fault.line);
  }
}

}  // namespace

fs::path file_beside(const Node& stated, std::string_view key_view, const fs::path& folder) {
  const std::string key(key_view);
  if (stated.kind != Node::Kind::text) refuse(stated, key, "must be the name of a file in quotes");
  const fs::path relative = stated.text;
  const bool escapes = relative.is_absolute() || std::find(relative.begin(), relative.end(), "..") != relative.end();
  if (escapes) refuse(stated, key, "must be in the scene's own folder: give its name without .. or a leading /");
  std::error_code error;
  if (text_fault(stated.text) || !fs::is_regular_file(folder / relative, error))
    refuse(stated, key, "there is no such file in the scene's folder");
  const fs::path file = fs::canonical(folder / relative, error);
  if (error || !is_below(file, fs::canonical(folder.empty() ? "." : folder, error)))
    refuse(stated, key, "is a link that leads out of the scene's own folder; copy the file into that folder");
  return file;
}

Node tables_of_files(const Node& scene, const fs::path& folder, FilesRead& read) {
  Node tables;
  tables.place = scene.place;
  add_tables(scene, folder, "joints_file", "joints", tables, read, joint_tables);
  add_tables(scene, folder, "blocks_file", "blocks", tables, read, block_tables);
  return tables;
}

}  // namespace voussoir
