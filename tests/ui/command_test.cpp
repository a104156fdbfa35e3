#include "subedit/errors.h"
#include "tests/support/temporary_folder.h"
#include "ui/command.h"
#include "ui/recorder.h"
#include "ui/replayer.h"

#include <gtest/gtest.h>

#include <fstream>
#include <limits>

namespace celadon::ui {
namespace {

TEST(Command, ReadsBackWhatItWrites) {
    const double awkward = 0.1 + 0.2;
    const Command command{"camera.orbit", {{"azimuth", awkward}, {"name", "a \"b\"\nc"}}};
    const std::string line = formatCommand(command);
    EXPECT_EQ(line.find('\n'), std::string::npos);
    const Command back = parseCommand(line);
    EXPECT_EQ(back.name, command.name);
    EXPECT_EQ(back.arguments, command.arguments);
    EXPECT_EQ(Arguments(back).number("azimuth"), awkward);
}

TEST(Command, RefusesWhatIsNone) {
    for (const char* line : {"", "{", "[]", "3", "{\"name\":\"x\"}", "{\"command\":3}"}) {
        EXPECT_THROW(static_cast<void>(parseCommand(line)), UsageError) << line;
    }
}

TEST(Arguments, RefuseMissingWrongAndInfinite) {
    const Command command{"x",
                          {{"text", "a"}, {"list", {1, 2}}, {"mixed", {1, "b", 2}}, {"half", 0.5}}};
    const Arguments a(command);
    EXPECT_THROW(static_cast<void>(a.number("absent")), UsageError);
    EXPECT_THROW(static_cast<void>(a.number("text")), UsageError);
    EXPECT_THROW(static_cast<void>(a.vector3("list")), UsageError);
    EXPECT_THROW(static_cast<void>(a.vector3("mixed")), UsageError);
    EXPECT_THROW(static_cast<void>(a.flag("half")), UsageError);
    EXPECT_THROW(static_cast<void>(a.integerWithin("half", 0, 1)), UsageError);
    EXPECT_THROW(static_cast<void>(a.numberWithin("half", 0.6, 1.0)), UsageError);
    const Command infinite{"x", {{"n", std::numeric_limits<double>::infinity()}}};
    EXPECT_THROW(static_cast<void>(Arguments(infinite).number("n")), UsageError);
    EXPECT_EQ(a.number("absent", 3.0), 3.0);
    EXPECT_EQ(a.vector2("list"), glm::dvec2(1.0, 2.0));
}

TEST(Dispatcher, TellsObserversOfWhatSucceededOnly) {
    Dispatcher dispatcher;
    std::vector<std::string> seen;
    dispatcher.add("good", "", [](const Arguments&) {});
    dispatcher.add(
        "window", "", [](const Arguments&) {}, false);
    dispatcher.add("bad", "", [](const Arguments& a) { static_cast<void>(a.number("absent")); });
    dispatcher.observe([&](const Command& command) { seen.push_back(command.name); });
    dispatcher.execute({"good"});
    dispatcher.execute({"window"});
    EXPECT_THROW(dispatcher.execute({"bad"}), UsageError);
    EXPECT_THROW(dispatcher.execute({"unknown"}), UsageError);
    EXPECT_EQ(seen, std::vector<std::string>{"good"});
}

TEST(Recorder, FileReadsBackAndErrorsNameTheLine) {
    const test::TemporaryFolder folder;
    const auto file = folder / "r.jsonl";
    {
        Recorder recorder(file);
        recorder.write({"a", {{"x", 1}}});
        recorder.write({"b"});
    }
    ASSERT_EQ(readCommands(file).size(), 2u);
    {
        std::ofstream stream(file, std::ios::app);
        stream << "# a remark\n\n{\"command\":";
    }
    try {
        static_cast<void>(readCommands(file));
        FAIL() << "a broken line was read";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("line 5"), std::string::npos) << error.what();
    }
    EXPECT_EQ(readCommands(file, Tail::MayBeCut).size(), 2u);
    EXPECT_THROW(static_cast<void>(readCommands(folder / "absent")), InputError);
}

TEST(Replayer, StopsForScreenshotsWhereTheyAreDue) {
    Replayer replayer({{"a"}, {"b"}, {"c"}}, {{2, "two"}, {0, "zero"}, {9, "late"}});
    EXPECT_EQ(replayer.dueScreenshot()->string(), "zero");
    EXPECT_FALSE(replayer.next());
    replayer.screenshotTaken();
    EXPECT_EQ(replayer.next()->name, "a");
    EXPECT_EQ(replayer.next()->name, "b");
    EXPECT_EQ(replayer.dueScreenshot()->string(), "two");
    EXPECT_FALSE(replayer.next());
    replayer.screenshotTaken();
    EXPECT_EQ(replayer.next()->name, "c");
    EXPECT_FALSE(replayer.isDone());
    EXPECT_EQ(replayer.dueScreenshot()->string(), "late");
    replayer.screenshotTaken();
    EXPECT_TRUE(replayer.isDone());
}

} // namespace
} // namespace celadon::ui
