#include "subedit/atomic_file.h"
#include "subedit/errors.h"
#include "tests/support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <string>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>
#include <vector>

namespace celadon {
namespace {

namespace fs = std::filesystem;
using test::messageOf;
using test::readText;
using test::TemporaryFolder;
using test::writeText;
using testing::HasSubstr;

TEST(AtomicFile, AppearsOnlyWhenCommitted) {
    const TemporaryFolder folder;
    const fs::path target = folder / "a.txt";
    AtomicFile file(target);
    file.write(std::as_bytes(std::span("abc", 3)));
    EXPECT_FALSE(fs::exists(target));
    file.commit();
    EXPECT_EQ(readText(target), "abc");
    EXPECT_EQ(folder.entryCount(), 1u);
}

TEST(AtomicFile, LeavesNoTraceAndTheEarlierFileWhenNotCommitted) {
    const TemporaryFolder folder;
    const fs::path target = folder / "a.txt";
    writeText(target, "earlier");
    {
        AtomicFile file(target);
        file.write(std::as_bytes(std::span("abc", 3)));
        EXPECT_EQ(folder.entryCount(), 2u);
    }
    EXPECT_EQ(readText(target), "earlier");
    EXPECT_EQ(folder.entryCount(), 1u);
}

TEST(AtomicFile, ReplacesTheEarlierFileAndKeepsItsPermissions) {
    const TemporaryFolder folder;
    const fs::path target = folder / "a.txt";
    writeText(target, "earlier and longer");
    ::chmod(target.c_str(), 0640);
    writeFileAtomically(target, "new");
    EXPECT_EQ(readText(target), "new");
    struct stat info {};
    ASSERT_EQ(::stat(target.c_str(), &info), 0);
    EXPECT_EQ(info.st_mode & 0777u, 0640u);
}

TEST(AtomicFile, FollowsLinks) {
    const TemporaryFolder folder;
    fs::create_directory(folder / "elsewhere");
    writeText(folder / "elsewhere/real.txt", "earlier");
    fs::create_symlink("elsewhere/real.txt", folder / "link.txt");
    writeFileAtomically(folder / "link.txt", "new");
    EXPECT_TRUE(fs::is_symlink(folder / "link.txt"));
    EXPECT_EQ(readText(folder / "elsewhere/real.txt"), "new");
}

TEST(AtomicFile, FollowsLinksToWhatDoesNotExistYet) {
    const TemporaryFolder folder;
    fs::create_directory(folder / "elsewhere");
    fs::create_symlink("second.txt", folder / "first.txt");
    fs::create_symlink("elsewhere/real.txt", folder / "second.txt");
    writeFileAtomically(folder / "first.txt", "new");
    EXPECT_TRUE(fs::is_symlink(folder / "first.txt"));
    EXPECT_TRUE(fs::is_symlink(folder / "second.txt"));
    EXPECT_EQ(readText(folder / "elsewhere/real.txt"), "new");
}

TEST(AtomicFile, NamesWhereALinkLeads) {
    const TemporaryFolder folder;
    fs::create_symlink("missing/a.txt", folder / "lost.txt");
    EXPECT_THAT(messageOf<OutputError>([&] { checkWritable(folder / "lost.txt"); }),
                HasSubstr((folder / "missing").string() + "' does not exist"));
    fs::create_symlink("circle.txt", folder / "circle.txt");
    EXPECT_THAT(messageOf<OutputError>([&] { checkWritable(folder / "circle.txt"); }),
                HasSubstr("cannot be followed"));
}

TEST(AtomicFile, WorksOnABareName) {
    const TemporaryFolder folder;
    const fs::path before = fs::current_path();
    fs::current_path(folder.path());
    writeFileAtomically("bare.txt", "x");
    fs::current_path(before);
    EXPECT_EQ(readText(folder / "bare.txt"), "x");
}

TEST(AtomicFile, NamesWhatStandsInTheWay) {
    const TemporaryFolder folder;
    const auto message = [](const fs::path& target) {
        return messageOf<OutputError>([&] { checkWritable(target); });
    };
    EXPECT_THAT(message(folder / "missing/a.png"), HasSubstr("does not exist"));
    EXPECT_THAT(message(folder / "missing/a.png"), HasSubstr((folder / "missing").string()));
    EXPECT_THAT(message(folder.path()), HasSubstr("is a folder"));
    EXPECT_THAT(message(folder.path().string() + "/"), HasSubstr("is a folder"));
    EXPECT_THAT(message(""), HasSubstr("no file name"));
    EXPECT_THAT(message("-"), HasSubstr("standard output"));
    EXPECT_THAT(message("/dev/null"), HasSubstr("device"));
    EXPECT_THAT(message(folder / std::string(300, 'a')), HasSubstr("too long"));
    writeText(folder / "file", "");
    EXPECT_THAT(message(folder / "file/a.png"), HasSubstr("not a folder"));
}

TEST(AtomicFile, ChecksWithoutATrace) {
    const TemporaryFolder folder;
    writeText(folder / "a.txt", "earlier");
    checkWritable(folder / "a.txt");
    checkWritable(folder / "b.txt");
    EXPECT_EQ(readText(folder / "a.txt"), "earlier");
    EXPECT_EQ(folder.entryCount(), 1u);
}

/// Permissions do not bind root: a test that needs them becomes somebody else meanwhile.
class WithoutPrivileges {
public:
    explicit WithoutPrivileges(const fs::path& folder) {
        constexpr uid_t kNobody = 65534;
        if (mWas == 0 && ::chown(folder.c_str(), kNobody, kNobody) == 0) {
            mWorks = ::seteuid(kNobody) == 0;
        }
    }
    ~WithoutPrivileges() {
        if (mWas == 0 && ::seteuid(0) != 0) {
            std::abort();
        }
    }
    WithoutPrivileges(const WithoutPrivileges&) = delete;
    WithoutPrivileges& operator=(const WithoutPrivileges&) = delete;
    [[nodiscard]] bool works() const { return mWorks; }

private:
    uid_t mWas = ::geteuid();
    bool mWorks = mWas != 0;
};

TEST(AtomicFile, RefusesProtectedFoldersAndFiles) {
    const TemporaryFolder folder;
    const WithoutPrivileges privileges(folder.path());
    if (!privileges.works()) {
        GTEST_SKIP() << "root cannot give up its privileges here";
    }
    fs::create_directory(folder / "closed");
    ASSERT_EQ(::chmod((folder / "closed").c_str(), 0500), 0);
    EXPECT_THAT(messageOf<OutputError>([&] { checkWritable(folder / "closed/a"); }),
                HasSubstr("not writable"));
    writeText(folder / "protected", "x");
    ASSERT_EQ(::chmod((folder / "protected").c_str(), 0400), 0);
    EXPECT_THAT(messageOf<OutputError>([&] { checkWritable(folder / "protected"); }),
                HasSubstr("write-protected"));
}

TEST(AtomicFile, KeepsTheEarlierFileWhenThereIsNoRoom) {
    const TemporaryFolder folder;
    const fs::path target = folder / "a.bin";
    writeText(target, "earlier");

    // A limit on file sizes stands for a full disk: write() fails half way in the same manner.
    rlimit before{};
    ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
    const auto oldHandler = std::signal(SIGXFSZ, SIG_IGN);
    rlimit small = before;
    small.rlim_cur = 4096;
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
    const std::vector<std::byte> bytes(100'000);
    const std::string message = messageOf<OutputError>([&] { writeFileAtomically(target, bytes); });
    ::setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, oldHandler);

    EXPECT_THAT(message, HasSubstr("larger than"));
    EXPECT_EQ(readText(target), "earlier");
    EXPECT_EQ(folder.entryCount(), 1u);
}

} // namespace
} // namespace celadon
