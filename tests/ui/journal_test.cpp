#include "tests/support/temporary_folder.h"
#include "ui/journal.h"

#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <unistd.h>

namespace celadon::ui {
namespace {

const Command kEdit{"paint.edit", {{"material", 0}}};

/// The journal of a process that is no more: its file renamed to a number that none has.
void abandon(const std::filesystem::path& folder) {
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        std::filesystem::rename(entry.path(), folder / "99999999.journal");
        return;
    }
    FAIL() << "there is no journal";
}

TEST(Journal, IsFoundAfterACrashAndHoldsWhatChangesMaterials) {
    const test::TemporaryFolder folder;
    {
        Journal journal(folder.path());
        journal.begin({"a model", "a material", {}, 250.0});
        EXPECT_FALSE(journal.add({"camera.orbit"}));
        EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
        EXPECT_FALSE(journal.add(kEdit));
        EXPECT_FALSE(journal.add({"edit.undo"}));
        EXPECT_FALSE(journal.add({"light.change", {{"light", 0}}}));
        EXPECT_FALSE(journal.add({"edit.undo", {{"setting", true}}})); // of the light
    } // as a crash: finish() was not called
    EXPECT_FALSE(findRecovery(folder.path())) << "of a process that lives";
    abandon(folder.path());
    const auto found = findRecovery(folder.path());
    ASSERT_TRUE(found);
    EXPECT_EQ(found->opened.model, "a model");
    EXPECT_EQ(found->opened.material, "a material");
    EXPECT_EQ(found->opened.diameterMm, 250.0);
    ASSERT_EQ(found->commands.size(), 2u);
    EXPECT_EQ(found->commands[1].name, "edit.undo");
}

TEST(Journal, LosesAtMostTheLineThatWasCut) {
    const test::TemporaryFolder folder;
    {
        Journal journal(folder.path());
        journal.begin({"m", ""});
        EXPECT_FALSE(journal.add(kEdit));
    }
    abandon(folder.path());
    std::ofstream(folder / "99999999.journal", std::ios::app) << "{\"command\":\"paint.ed";
    const auto found = findRecovery(folder.path());
    ASSERT_TRUE(found);
    EXPECT_EQ(found->commands.size(), 1u);
}

TEST(Journal, CountsADragAsOneStep) {
    const test::TemporaryFolder folder;
    {
        Journal journal(folder.path());
        journal.begin({"m", ""});
        EXPECT_FALSE(journal.add(kEdit));
        for (const bool continues : {false, true, true}) {
            EXPECT_FALSE(
                journal.add({"deform.change", {{"deformer", 0}, {"continues", continues}}}));
        }
    }
    abandon(folder.path());
    const auto found = findRecovery(folder.path());
    ASSERT_TRUE(found);
    EXPECT_EQ(found->commands.size(), 4u);
    EXPECT_EQ(found->steps(), 2u);
}

TEST(Journal, SaysWhyItEnded) {
    const test::TemporaryFolder folder;
    {
        Journal journal(folder.path());
        journal.begin({"m", ""});
        journal.explain("nothing was done: nothing to recover");
        EXPECT_FALSE(journal.add(kEdit));
        journal.explain("the driver was reset");
    }
    abandon(folder.path());
    const auto found = findRecovery(folder.path());
    ASSERT_TRUE(found);
    EXPECT_EQ(found->commands.size(), 1u);
    EXPECT_EQ(found->reason, "the driver was reset");
}

TEST(Journal, LeavesNothingBehindWhenFinished) {
    const test::TemporaryFolder folder;
    Journal journal(folder.path());
    journal.begin({"m", ""});
    EXPECT_FALSE(journal.add(kEdit));
    EXPECT_FALSE(std::filesystem::is_empty(folder.path()));
    journal.finish();
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(Journal, KeepsAMaterialThatIsSavedOver) {
    const test::TemporaryFolder folder;
    const std::filesystem::path state = folder / "state";
    const std::filesystem::path file = folder / "wax.subedit.exr";
    const auto write = [&](const std::string& text) {
        // As every writer here does: another file takes the name.
        std::ofstream(folder / "pending") << text;
        std::filesystem::rename(folder / "pending", file);
    };
    const auto read = [](const std::filesystem::path& path) {
        std::ifstream stream(path);
        std::string text;
        std::getline(stream, text);
        return text;
    };
    write("as opened");
    {
        Journal journal(state);
        journal.begin({"m", ""});         // the model names the material
        EXPECT_FALSE(journal.keep(file)); // nothing has been done: nothing to keep
        EXPECT_FALSE(std::filesystem::exists(state));
        EXPECT_FALSE(journal.add(kEdit));
        EXPECT_FALSE(journal.keep(folder / "new.subedit.exr"));
        EXPECT_FALSE(journal.keep(folder / "state" / ".." / "wax.subedit.exr"));
        write("saved");
        EXPECT_FALSE(journal.add({"edit.undo"}));
        EXPECT_FALSE(journal.keep(file)); // what stands there now is this session's
        write("saved again");
    }
    std::filesystem::rename(state / (std::to_string(::getpid()) + ".journal"),
                            state / "99999999.journal");
    const auto found = findRecovery(state);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->commands.size(), 2u);
    EXPECT_EQ(found->opened.model, "m");
    EXPECT_EQ(found->opened.material, "");
    ASSERT_EQ(found->opened.readInstead.size(), 1u);
    const auto& [named, kept] = *found->opened.readInstead.begin();
    EXPECT_EQ(named, std::filesystem::canonical(file));
    EXPECT_EQ(read(kept), "as opened");
    EXPECT_EQ(read(file), "saved again");

    // The session that recovers goes on with what was kept, and cleans up when it ends.
    Journal next(state);
    next.begin(found->opened);
    EXPECT_FALSE(next.add(kEdit));
    EXPECT_FALSE(next.keep(file));
    EXPECT_TRUE(std::filesystem::exists(kept));
    next.finish();
    EXPECT_FALSE(std::filesystem::exists(kept));
    discard(*found);
    EXPECT_TRUE(std::filesystem::is_empty(state));
    EXPECT_TRUE(std::filesystem::exists(file));
}

TEST(Journal, RemovesNoFileThatItDidNotKeep) {
    const test::TemporaryFolder folder;
    const std::filesystem::path mine = folder / "mine.kept.exr";
    std::ofstream(mine) << "mine";
    const Recovery recovery{folder / "state" / "1.journal", {"m", "", {{mine, mine}}}, {}};
    discard(recovery);
    EXPECT_TRUE(std::filesystem::exists(mine));
}

TEST(Journal, RubbishIsNoRecovery) {
    const test::TemporaryFolder folder;
    std::ofstream(folder / "99999998.journal") << "rubbish\nmore\n";
    std::ofstream(folder / "99999997.journal") << "";
    EXPECT_FALSE(findRecovery(folder.path()));
    EXPECT_FALSE(findRecovery(folder / "absent"));
}

TEST(Journal, SaysOnceThatItCannotWrite) {
    Journal journal("/proc/no/such/folder");
    journal.begin({"m", ""});
    EXPECT_TRUE(journal.add(kEdit));
    EXPECT_FALSE(journal.add(kEdit));
}

} // namespace
} // namespace celadon::ui
