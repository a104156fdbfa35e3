#pragma once

#include "tests/support/program.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

/// Tests of one command's subcommands, within the test's process and in a folder of their own.
namespace celadon::test {

using Words = std::vector<std::string>;

class CommandTest : public testing::Test {
protected:
    explicit CommandTest(std::string command) : mCommand(std::move(command)) {}

    std::string file(const std::string& name) const { return (folder / name).string(); }

    ProgramResult run(Words words) const {
        words.insert(words.begin(), mCommand);
        return runInProcess(words);
    }
    ProgramResult expectDone(const Words& words) const {
        ProgramResult result = run(words);
        EXPECT_EQ(result.exitCode, 0) << result.err;
        return result;
    }
    void expectRefused(const Words& words, int code,
                       const testing::Matcher<std::string>& says) const {
        const ProgramResult result = run(words);
        EXPECT_EQ(result.exitCode, code) << result.err;
        EXPECT_EQ(result.out, "");
        EXPECT_THAT(result.err, says);
    }

    TemporaryFolder folder;

private:
    std::string mCommand;
};

} // namespace celadon::test
