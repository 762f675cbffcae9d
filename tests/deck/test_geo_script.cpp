// A .geo file may describe a mesh and do nothing else.
#include <gtest/gtest.h>

#include <chrono>

#include "deck/fake_engine.hpp"
#include "intake/geo_script.hpp"

namespace dygita::test::geo_script_tests {

namespace {

std::string refusal(const std::string& text, const std::string& name = "part.geo") {
  const Folder folder;
  try {
    check_script(folder.write(name, text).string());
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(GeoScript, of_geometry_and_meshes_passes) {
  EXPECT_EQ(refusal(R"(// SystemCall in a comment, and "quotes
/* Print "x.pos"; over
   lines */
SetFactory("OpenCASCADE");
DefineConstant[ size = {0.01, Name "SystemCall"} ];
Macro Slab
  Box(1) = {0, 0, 0, 1, 1, size};
Return
Call Slab;
If (size > 1) Printf("size %g", size); EndIf
Mesh.SaveAll = 1;
)"),
            "");
}

TEST(GeoScript, that_does_more_is_refused_with_its_line) {
  for (const std::string word : {"SystemCall \"ls\"", "NonBlockingSystemCall \"ls\"", "OnelabRun \"a\"",
                                 "CreateDir \"a\"", "Print \"a.png\"", "Save \"a.msh\"", "Exit", "Sleep 100",
                                 "Plugin(Skin).Run", "General.ErrorFileName = \"a\"", "Solver.Executable0 = \"a\""}) {
    const std::string message = refusal("Point(1) = {0, 0, 0};\n" + word + ";\n");
    EXPECT_EQ(message.find("part.geo:2: '" + word.substr(0, word.find_first_of(" (")) + "' is refused"), 0u)
        << word << ": " << message;
  }
  EXPECT_EQ(refusal("Printf(\"x\") > \"file\";").find("part.geo:1: 'Printf' into a file is refused"), 0u);
}

TEST(GeoScript, that_merges_files_which_merge_others_many_times_reads_each_once) {
  const Folder folder;
  for (int i = 0; i < 12; ++i) {
    std::string text;
    const std::string next = "part" + std::to_string(i + 1) + ".geo";
    for (int k = 0; k < 20; ++k) text += "Merge \"" + next + "\";\nMerge \"./" + next + "\";\n";
    folder.write("part" + std::to_string(i) + ".geo", text);
  }
  folder.write("part12.geo", "Point(1) = {0, 0, 0};\n");
  const auto start = std::chrono::steady_clock::now();
  EXPECT_NO_THROW(check_script((folder.path() / "part0.geo").string()));
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));  // 40^12 without
}

TEST(GeoScript, is_followed_into_the_files_it_reads) {
  const Folder folder;
  folder.write("inner.geo", "\nSystemCall \"ls\";\n");
  const auto outer = folder.write("outer.geo", "Include \"inner.geo\";\n");
  EXPECT_THROW(check_script(outer.string()), InputError);
  folder.write("inner.geo", "Point(1) = {0, 0, 0};\n");
  EXPECT_NO_THROW(check_script(outer.string()));
  folder.write("inner.geo", "Merge \"outer.geo\";\n");
  EXPECT_THROW(check_script(outer.string()), InputError) << "a circle";
  EXPECT_NE(refusal("Merge StrCat(\"a\", \".geo\");"), "");
  EXPECT_NE(refusal("Merge \"nowhere.step\";"), "");
}

TEST(GeoScript, cannot_hide_in_another_kind_of_file) {
  EXPECT_NE(refusal("SystemCall \"ls\";", "part.msh"), "");
  EXPECT_NE(refusal("SystemCall \"ls\";", "part.txt"), "");
  EXPECT_EQ(refusal("$MeshFormat\n4.1 0 8\n$EndMeshFormat\n", "part.msh"), "");
  const Folder folder;
  folder.write("part.geo.opt", "General.Terminal = 1;\n");
  EXPECT_THROW(check_script(folder.write("part.geo", "Point(1) = {0, 0, 0};\n").string()), InputError);
}

}  // namespace

}  // namespace dygita::test::geo_script_tests
