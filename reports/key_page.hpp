#pragma once
// A page of a list in markdown that a program writes: keys of scenes, columns, keys of studies, public headers.
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace voussoir::reports {

// The part of the list that begins with its title of a number, counted from zero; every key has an anchor. If the list
// does not exist the page, and `missing`, names its maker.
std::string list_page(const std::filesystem::path& list, std::size_t number, const std::string& id,
                      const std::string& title, const std::string& maker, std::vector<std::string>& missing);

}  // namespace voussoir::reports
