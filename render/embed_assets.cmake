# cmake -D ROOT=assets -D FILES=a,b,c -D OUT=assets.cpp -P embed_assets.cmake
# Writes the files as string constants. A string literal may be limited to 64 KiB by compilers, so
# contents are given as character arrays.
string(REPLACE "," ";" FILES "${FILES}")
set(arrays "")
set(entries "")
set(index 0)
foreach(file IN LISTS FILES)
  file(READ ${ROOT}/${file} hex HEX)
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "'\\\\x\\1'," bytes "${hex}")
  string(APPEND arrays "constexpr char kAsset${index}[] = {${bytes}'\\0'};\n")
  string(APPEND entries "    {\"${file}\", {kAsset${index}, sizeof kAsset${index} - 1}},\n")
  math(EXPR index "${index} + 1")
endforeach()
file(WRITE ${OUT} "// Made by embed_assets.cmake from assets/.
#include \"render/assets.hpp\"

#include <cassert>

namespace armsreach::render {
namespace {

${arrays}
struct Asset {
  std::string_view name;
  std::string_view contents;
};
constexpr Asset kAssets[] = {
${entries}};

}  // namespace

std::string_view asset(std::string_view name) {
  for (const Asset& one : kAssets) {
    if (one.name == name) return one.contents;
  }
  assert(false);
  return {};
}

}  // namespace armsreach::render
")
