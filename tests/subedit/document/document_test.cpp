#include "subedit/document/document.h"
#include "subedit/document/edit_tables.h"
#include "subedit/radius_map.h"
#include "tests/subedit/support/profiles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace celadon::subedit {
namespace {

constexpr int kSize = 80;

std::shared_ptr<const Surface> flat() {
    return std::make_shared<Surface>(makeFlatSurface(kSize, kSize, 80.0f));
}

StrokePoint point(float x, float y) {
    StrokePoint p;
    p.positionMm = {x, -y, 0.0f};
    p.normal = {0.0f, 0.0f, 1.0f};
    return p;
}

StrokeCommand stroke(const EditOperator& op, float x0, float y0, float x1, float y1) {
    return {op, {.radiusMm = 6.0f, .flow = 0.7f}, {}, {point(x0, y0), point(x1, y1)}};
}

EditOperator randomOperator(std::mt19937& random) {
    std::uniform_real_distribution<float> unit(0.0f, 1.0f);
    const auto color = [&] { return glm::vec3(unit(random), unit(random), unit(random)) + 0.1f; };
    const MaterialMap exponential = test::exponentialMaterial(16, 18.0f, color() * 3.0f, 0.02f);
    const StoredProfile profile{16, 18.0f, exponential.logProfile};
    switch (random() % 10) {
    case 7:
        return Heterogeneity{2.0f * unit(random) - 1.0f, 1.0f + 8.0f * unit(random)};
    case 8:
        return Clone{{point(20.0f, 60.0f), point(40.0f, 30.0f), 90.0f * unit(random)}};
    case 9:
        return TransferPattern{{point(20.0f, 60.0f), point(40.0f, 30.0f), 0.0f}, 5.0f, 1.5f};
    case 0:
        return ScaleAlbedo{color() * 1.5f};
    case 1:
        return SetAlbedo{color() / 1.1f};
    case 2:
        return Tint{color(), unit(random)};
    case 3:
        return ScaleRange{color() + 0.5f};
    case 4:
        return SetRange{color() * 10.0f};
    case 5:
        return SetShape{profile};
    default:
        return Mix{profile, unit(random)};
    }
}

TEST(Document, UndoGivesBackTheBytes) {
    const MaterialMap original = test::varyingMaterial(kSize, kSize, 16);
    Document document(original, flat());
    std::mt19937 random(1);
    std::vector<std::vector<float>> states{original.logProfile};
    for (int i = 0; i < 12; ++i) {
        const EditOperator op = randomOperator(random);
        if (i % 4 == 3) {
            document.execute(ApplyCommand{op});
        } else {
            document.execute(stroke(op, 10.0f, 20.0f + 3.0f * static_cast<float>(i), 70.0f, 40.0f));
        }
        states.push_back(document.material().logProfile);
        EXPECT_NE(states[states.size() - 1], states[states.size() - 2]) << operatorName(op);
    }
    for (std::size_t i = states.size() - 1; i-- > 0;) {
        ASSERT_TRUE(document.undo());
        ASSERT_EQ(document.material().logProfile, states[i]) << "after undo to " << i;
    }
    EXPECT_FALSE(document.undo());
    EXPECT_EQ(document.material().maxRadiusMm, original.maxRadiusMm);
    for (std::size_t i = 1; i < states.size(); ++i) {
        ASSERT_TRUE(document.redo());
        ASSERT_EQ(document.material().logProfile, states[i]) << "after redo to " << i;
    }
    EXPECT_FALSE(document.redo());
}

TEST(Document, AStrokeAsItHappensIsTheStrokeAtOnce) {
    const MaterialMap original = test::varyingMaterial(kSize, kSize, 16);
    std::mt19937 random(2);
    for (int i = 0; i < 10; ++i) {
        const EditOperator op = randomOperator(random);
        StrokeCommand command = stroke(op, 10.0f, 12.0f, 40.0f, 50.0f);
        command.path.push_back(point(70.0f, 20.0f));
        Document atOnce(original, flat());
        const EditReport expected = atOnce.execute(command);

        Document live(original, flat());
        StrokeCommand begun = command;
        begun.path.resize(1);
        live.beginStroke(begun);
        live.addStrokePoint(command.path[1]);
        live.addStrokePoint(command.path[2]);
        const EditReport report = live.endStroke();
        ASSERT_EQ(live.material().logProfile, atOnce.material().logProfile) << operatorName(op);
        EXPECT_EQ(live.material().maxRadiusMm, atOnce.material().maxRadiusMm);
        EXPECT_EQ(report.texels, expected.texels);
        EXPECT_EQ(report.energyClamped, expected.energyClamped);
        EXPECT_EQ(live.commands(), atOnce.commands());
        ASSERT_TRUE(live.undo());
        ASSERT_EQ(live.material().logProfile, original.logProfile) << operatorName(op);
    }
}

/// Now and then takes the latest step back, and perhaps does it again.
/// @param states of the material after each step
/// @return whether it did
bool isUndoneOnTheWay(Document& document, std::mt19937& random,
                      std::vector<std::vector<float>>& states) {
    if (random() % 4 != 0 || !document.undo()) {
        return false;
    }
    states.pop_back();
    EXPECT_EQ(document.material().logProfile, states.back()) << "step " << states.size();
    if (random() % 2 == 0) {
        EXPECT_TRUE(document.redo());
        states.push_back(document.material().logProfile);
    }
    return true;
}

/// With no memory for profiles all but what is irreplaceable is computed again.
TEST(Document, UndoGivesBackTheBytesWhenTheHistoryIsTrimmed) {
    const MaterialMap original = test::varyingMaterial(kSize, kSize, 16);
    for (unsigned seed = 1; seed <= 4; ++seed) {
        Document document(original, flat(), {.profileBytes = 0});
        std::mt19937 random(seed);
        std::uniform_real_distribution<float> place(5.0f, 75.0f);
        std::vector<std::vector<float>> states{original.logProfile};
        for (int i = 0; i < 40; ++i) {
            if (isUndoneOnTheWay(document, random, states)) {
                continue;
            }
            const EditOperator op = randomOperator(random);
            if (random() % 6 == 0) {
                document.execute(ApplyCommand{op});
            } else if (random() % 6 == 0) {
                document.execute(SelectCommand{
                    SelectStroke{{.radiusMm = 30.0f}, {}, {point(place(random), place(random))}},
                    random() % 2 == 0 ? SelectMode::Replace : SelectMode::Add});
            } else {
                document.execute(
                    stroke(op, place(random), place(random), place(random), place(random)));
            }
            states.push_back(document.material().logProfile);
        }
        const std::vector<EditCommand> commands = document.commands();
        for (std::size_t i = states.size() - 1; i-- > 0;) {
            ASSERT_TRUE(document.undo());
            ASSERT_EQ(document.material().logProfile, states[i]) << "seed " << seed << ", " << i;
        }
        EXPECT_EQ(document.material().maxRadiusMm, original.maxRadiusMm);
        for (std::size_t i = 1; i < states.size(); ++i) {
            ASSERT_TRUE(document.redo());
            ASSERT_EQ(document.material().logProfile, states[i]) << "seed " << seed << ", " << i;
        }
        // And the commands alone, on the material as it was, give the same.
        Document replayed(original, flat());
        for (const EditCommand& command : commands) {
            replayed.execute(command);
        }
        ASSERT_EQ(replayed.material().logProfile, states.back());
    }
}

TEST(Document, HistoryStaysWithinItsBudget) {
    constexpr std::size_t kBudget = std::size_t{1} << 20;
    const MaterialMap original = test::varyingMaterial(kSize, kSize, 16);
    const std::size_t mapBytes = original.logProfile.size() * sizeof(float);
    Document document(original, flat(), {.profileBytes = kBudget});
    std::mt19937 random(5);
    std::uniform_real_distribution<float> place(5.0f, 75.0f);
    constexpr std::size_t kStrokes = 150;
    std::size_t painted = 0;
    for (std::size_t i = 0; i < kStrokes; ++i) {
        painted += document
                       .execute(stroke(ScaleAlbedo{{0.9f, 1.0f, 0.95f}}, place(random),
                                       place(random), place(random), place(random)))
                       .texels;
    }
    // Untrimmed it would be several times as much.
    EXPECT_GT(painted * 17 * 3 * sizeof(float), 5 * (mapBytes + kBudget));
    // The first profile of each texel, the budget, and weights and dabs of each stroke.
    EXPECT_LT(document.historyBytes(), mapBytes + kBudget + kStrokes * 40000);
    while (document.undo()) {
    }
    EXPECT_EQ(document.material().logProfile, original.logProfile);
    while (document.redo()) {
    }
    EXPECT_LT(document.historyBytes(), mapBytes + kBudget + kStrokes * 40000);
}

/// Random edits, some undone and done again on the way, within so little memory that the oldest
/// must go: what can be undone gives back the bytes that were there.
TEST(Document, ForgetsTheOldestCommandsAndUndoesTheRestToTheByte) {
    const MaterialMap original = test::varyingMaterial(kSize, kSize, 16);
    std::size_t forgotten = 0;
    for (unsigned seed = 1; seed <= 6; ++seed) {
        // Profiles are trimmed as well, or not.
        const std::size_t budget = std::size_t{2} << 20;
        Document document(original, flat(),
                          {.profileBytes = seed % 2 == 0 ? 0 : budget, .historyBytes = budget});
        std::mt19937 random(seed);
        std::uniform_real_distribution<float> place(5.0f, 75.0f);
        std::vector<std::vector<float>> states{original.logProfile};
        for (int i = 0; i < 60; ++i) {
            if (isUndoneOnTheWay(document, random, states)) {
                continue;
            }
            if (random() % 8 == 0) {
                document.execute(SelectCommand{
                    SelectStroke{{.radiusMm = 30.0f}, {}, {point(place(random), place(random))}},
                    random() % 2 == 0 ? SelectMode::Replace : SelectMode::Add});
            } else {
                document.execute(stroke(randomOperator(random), place(random), place(random),
                                        place(random), place(random)));
            }
            states.push_back(document.material().logProfile);
            // The latest command, however large, and what it takes to compute the rest.
            ASSERT_LT(document.historyBytes(), 3 * budget) << "step " << i;
        }
        const std::size_t commands = document.commandCount();
        ASSERT_EQ(document.commands().size(), states.size() - 1);
        std::size_t undone = 0;
        while (document.undo()) {
            states.pop_back();
            ASSERT_EQ(document.material().logProfile, states.back()) << "seed " << seed;
            ++undone;
        }
        EXPECT_GE(undone, 1u);
        forgotten += commands - undone;
        for (std::size_t i = 0; i < undone; ++i) {
            ASSERT_TRUE(document.redo());
        }
    }
    EXPECT_GT(forgotten, 20u);
}

/// Masks of selections are shared between the history and the selection itself: counted once.
TEST(Document, SelectionsCountAsHistory) {
    Document document(test::varyingMaterial(kSize, kSize, 16), flat());
    std::size_t before = document.historyBytes();
    constexpr std::size_t kTiles = 9; // of 32 x 32 texels, on a map of 80 x 80
    for (int i = 0; i < 4; ++i) {
        const auto x = 10.0f + 10.0f * static_cast<float>(i);
        document.execute(SelectCommand{SelectStroke{{.radiusMm = 60.0f}, {}, {point(x, 40.0f)}},
                                       SelectMode::Replace});
        const std::size_t grown = document.historyBytes() - before;
        EXPECT_GT(grown, sizeof(WeightMask::Tile));
        EXPECT_LT(grown, kTiles * sizeof(WeightMask::Tile) + 4096);
        before = document.historyBytes();
    }
}

TEST(Document, LessHistoryIsForgottenAtOnce) {
    Document document(test::varyingMaterial(kSize, kSize, 16), flat());
    for (int i = 0; i < 5; ++i) {
        document.execute(stroke(ScaleAlbedo{glm::vec3(0.9f)}, 20.0f, 20.0f, 60.0f, 60.0f));
    }
    const std::vector<float> before = document.material().logProfile;
    document.setHistoryBytes(0);
    EXPECT_EQ(document.material().logProfile, before);
    EXPECT_EQ(document.commandCount(), 5u);
    EXPECT_TRUE(document.undo());
    EXPECT_FALSE(document.undo());
    EXPECT_TRUE(document.redo());
    EXPECT_EQ(document.material().logProfile, before);
}

TEST(Document, SelectionBoundsEditsAndIsUndone) {
    const MaterialMap original = test::varyingMaterial(kSize, kSize, 16);
    Document document(original, flat());
    document.execute(SelectCommand{SelectStroke{{.radiusMm = 10.0f}, {}, {point(20.0f, 20.0f)}},
                                   SelectMode::Replace});
    EXPECT_TRUE(document.takeChanges().selectionChanged);
    const EditReport report = document.execute(ApplyCommand{ScaleAlbedo{glm::vec3(0.5f)}});
    EXPECT_EQ(report.texels, document.selection().countNonZero());
    EXPECT_NE(document.material().logKnot(20, 20, 0), original.logKnot(20, 20, 0));
    EXPECT_EQ(document.material().logKnot(40, 20, 0), original.logKnot(40, 20, 0));
    ASSERT_TRUE(document.undo());
    EXPECT_EQ(commandTitle(*document.undoCommand()), "select stroke");
    ASSERT_TRUE(document.undo());
    EXPECT_EQ(document.selection(), WeightMask::full(kSize, kSize));
    EXPECT_EQ(document.material().logProfile, original.logProfile);
}

TEST(Document, ACanceledStrokeLeavesNothing) {
    const MaterialMap original = test::varyingMaterial(kSize, kSize, 16);
    Document document(original, flat());
    document.beginStroke(stroke(ScaleRange{glm::vec3(2.0f)}, 10.0f, 10.0f, 60.0f, 60.0f));
    EXPECT_NE(document.material().logProfile, original.logProfile);
    document.cancelStroke();
    EXPECT_EQ(document.material().logProfile, original.logProfile);
    EXPECT_EQ(document.material().maxRadiusMm, original.maxRadiusMm);
    EXPECT_FALSE(document.canUndo());
}

/// A document of several dozens of tiles, with one edit done and one undone.
std::unique_ptr<Document> largeDocument() {
    constexpr int kLarge = 256;
    auto document = std::make_unique<Document>(
        test::varyingMaterial(kLarge, kLarge, 16),
        std::make_shared<Surface>(makeFlatSurface(kLarge, kLarge, 256.0f)));
    document->execute(ApplyCommand{ScaleAlbedo{{0.9f, 0.8f, 0.7f}}});
    document->execute(ApplyCommand{ScaleAlbedo{{0.5f, 0.8f, 0.7f}}});
    document->undo();
    static_cast<void>(document->takeChanges());
    return document;
}

TEST(Document, AnEditThatIsGivenUpLeavesNothing) {
    struct GivenUp {};
    Propagation propagation;
    propagation.scribbles.push_back({{.radiusMm = 6.0f}, {}, {point(40.0f, 40.0f)}, 1.0f});
    propagation.scribbles.push_back({{.radiusMm = 6.0f}, {}, {point(200.0f, 40.0f)}, 0.0f});
    const std::vector<EditCommand> edits{
        ApplyCommand{ScaleAlbedo{{0.5f, 0.6f, 0.7f}}},
        ApplyCommand{ScaleRange{{9.0f, 9.0f, 9.0f}}}, // r_s grows
        ApplyCommand{Heterogeneity{0.5f, 4.0f}},
        SelectCommand{FeatherSelection{12.0f}},
        SelectCommand{SelectSimilar{point(40.0f, 40.0f), 0.2f, {}, {}}, SelectMode::Replace},
        PropagateCommand{Tint{{1.0f, 0.5f, 0.2f}, 0.5f}, propagation},
    };
    for (std::size_t e = 0; e < edits.size(); ++e) {
        SCOPED_TRACE(e);
        const auto untouched = largeDocument();
        const auto document = largeDocument();
        const auto giveUpAfter = [&](int calls) {
            document->execute(edits[e], [&](float done) {
                EXPECT_LE(done, 1.0f);
                if (calls-- == 0) {
                    throw GivenUp();
                }
            });
        };
        for (int calls = 0;; ++calls) {
            try {
                giveUpAfter(calls);
                break; // it was not asked so often
            } catch (const GivenUp&) {
            }
            ASSERT_EQ(document->material().logProfile, untouched->material().logProfile) << calls;
            ASSERT_EQ(document->material().maxRadiusMm, untouched->material().maxRadiusMm);
            ASSERT_EQ(document->selection(), untouched->selection());
            ASSERT_EQ(document->commandCount(), 1u);
            ASSERT_TRUE(document->canRedo());
        }
        untouched->execute(edits[e]);
        EXPECT_EQ(document->material().logProfile, untouched->material().logProfile);
        EXPECT_EQ(document->selection(), untouched->selection());
        EXPECT_EQ(document->commandCount(), 2u);
        document->undo();
        EXPECT_EQ(document->material().logProfile, largeDocument()->material().logProfile);
    }
}

TEST(Document, UndoAndRedoThatAreGivenUpLeaveNothing) {
    struct GivenUp {};
    constexpr int kLarge = 256;
    constexpr int kEdits = 40; // of which none but the first is kept, so undoing takes its time
    DocumentSettings settings;
    settings.profileBytes = 0;
    Document document(test::varyingMaterial(kLarge, kLarge, 16),
                      std::make_shared<Surface>(makeFlatSurface(kLarge, kLarge, 256.0f)), settings);
    std::vector<float> before;
    for (int i = 0; i < kEdits; ++i) {
        before = document.material().logProfile;
        document.execute(ApplyCommand{ScaleAlbedo{{0.99f, 0.98f, 0.97f}}});
    }
    const std::vector<float> after = document.material().logProfile;
    const auto isDone = [&](auto&& action, int calls) {
        try {
            action([&calls](float) {
                if (calls-- == 0) {
                    throw GivenUp();
                }
            });
            return true;
        } catch (const GivenUp&) {
            return false;
        }
    };
    int asked = 0;
    while (!isDone([&](const EditProgress& progress) { document.undo(progress); }, asked)) {
        ++asked;
        ASSERT_EQ(document.material().logProfile, after);
        ASSERT_EQ(document.commandCount(), std::size_t{kEdits});
    }
    EXPECT_GT(asked, 0);
    EXPECT_EQ(document.material().logProfile, before);
    for (asked = 0; !isDone([&](const EditProgress& progress) { document.redo(progress); }, asked);
         ++asked) {
        ASSERT_EQ(document.material().logProfile, before);
        ASSERT_EQ(document.commandCount(), std::size_t{kEdits - 1});
    }
    EXPECT_GT(asked, 0);
    EXPECT_EQ(document.material().logProfile, after);
}

TEST(Document, ARedoThatIsGivenUpWhileProfilesGrowCanBeDoneAndUndone) {
    struct GivenUp {};
    const auto document = largeDocument();
    const std::vector<float> before = document->material().logProfile;
    const float r_s = document->material().maxRadiusMm;
    document->execute(ApplyCommand{ScaleRange{{9.0f, 9.0f, 9.0f}}});
    const std::vector<float> after = document->material().logProfile;
    ASSERT_GT(document->material().maxRadiusMm, r_s);
    document->undo();
    for (int calls = 0;; ++calls) {
        try {
            int left = calls;
            document->redo([&left](float) {
                if (left-- == 0) {
                    throw GivenUp();
                }
            });
            EXPECT_GT(calls, 1); // once before the profiles grew, once after
            break;
        } catch (const GivenUp&) {
            ASSERT_EQ(document->material().logProfile, before) << calls;
            ASSERT_EQ(document->material().maxRadiusMm, r_s);
        }
    }
    EXPECT_EQ(document->material().logProfile, after);
    ASSERT_TRUE(document->undo());
    EXPECT_EQ(document->material().logProfile, before);
    EXPECT_EQ(document->material().maxRadiusMm, r_s);
    ASSERT_TRUE(document->redo());
    EXPECT_EQ(document->material().logProfile, after);
}

TEST(Document, AFillTellsHowFarItIs) {
    const auto document = largeDocument();
    std::vector<float> told;
    document->execute(ApplyCommand{ScaleAlbedo{{0.5f, 0.6f, 0.7f}}}, [&](float done) {
        if (done >= 0.0f) {
            told.push_back(done);
        }
    });
    EXPECT_GE(told.size(), 4u);
    EXPECT_TRUE(std::ranges::is_sorted(told));
    EXPECT_EQ(told.back(), 1.0f);
}

TEST(Document, GrowsTheRadiusWhereAnEditNeedsIt) {
    const MaterialMap original = test::varyingMaterial(kSize, kSize, 16);
    Document document(original, flat());
    const EditReport report = document.execute(ApplyCommand{ScaleRange{glm::vec3(1.5f)}});
    ASSERT_TRUE(report.grownRadiusMm.has_value());
    EXPECT_GT(*report.grownRadiusMm, original.maxRadiusMm);
    EXPECT_EQ(report.rangeClamped, 0u);
    EXPECT_TRUE(document.takeChanges().layoutChanged);
    const MaterialMap& grown = document.material();
    for (int i = 0; i < kSize; i += 7) {
        const ProfileView before{original.logProfile.data() + original.index(i, i, 0), 16, 20.0f};
        const ProfileView after = profileAt(grown, i, i);
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(diffuseAlbedo(after)[c], diffuseAlbedo(before)[c],
                        3e-4 * diffuseAlbedo(before)[c]);
            EXPECT_NEAR(effectiveRadiusMm(after)[c] / effectiveRadiusMm(before)[c], 1.5, 0.03);
        }
    }
    // Beyond the stated limit nothing is cut silently: the texels are counted.
    const EditReport beyond = document.execute(ApplyCommand{ScaleRange{glm::vec3(20.0f)}});
    EXPECT_GT(beyond.rangeClamped, 0u);
    EXPECT_LE(document.material().maxRadiusMm, original.maxRadiusMm * kLargestGrowth * 1.0001f);
    ASSERT_TRUE(document.undo());
    ASSERT_TRUE(document.undo());
    EXPECT_EQ(document.material().logProfile, original.logProfile);
}

TEST(Document, ReportsWhatChangedAndNothingElse) {
    const MaterialMap original = test::varyingMaterial(kSize, kSize, 16);
    Document document(original, flat());
    static_cast<void>(document.takeChanges());
    document.execute(stroke(ScaleAlbedo{glm::vec3(0.5f)}, 20.0f, 20.0f, 24.0f, 20.0f));
    const DocumentChanges changes = document.takeChanges();
    EXPECT_FALSE(changes.layoutChanged);
    std::vector<bool> isReported(kSize * kSize, false);
    for (const TexelRect& rect : changes.rects) {
        for (int y = rect.y; y < rect.bottom(); ++y) {
            for (int x = rect.x; x < rect.right(); ++x) {
                isReported[static_cast<std::size_t>(y * kSize + x)] = true;
            }
        }
    }
    for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize; ++x) {
            if (document.material().logKnot(x, y, 0) != original.logKnot(x, y, 0)) {
                EXPECT_TRUE(isReported[static_cast<std::size_t>(y * kSize + x)]);
            }
        }
    }
    EXPECT_FALSE(isReported.back());
    EXPECT_TRUE(document.takeChanges().isEmpty());
    document.undo();
    EXPECT_EQ(document.takeChanges().rects, changes.rects);
}

TEST(EditTables, FollowEditsToTheBit) {
    Document document(test::varyingMaterial(kSize, kSize, 16), flat());
    EditTables tables(document.material());
    static_cast<void>(tables.rangeTable());
    std::mt19937 random(3);
    for (int i = 0; i < 6; ++i) {
        document.execute(
            stroke(randomOperator(random), 10.0f, 10.0f * static_cast<float>(i), 70.0f, 40.0f));
        const DocumentChanges changes = document.takeChanges();
        if (changes.layoutChanged) {
            tables.rebuild(document.material());
        } else {
            tables.update(document.material(), changes.rects);
        }
        EditTables anew(document.material());
        ASSERT_TRUE(std::equal(tables.effectiveRadiusMm().begin(), tables.effectiveRadiusMm().end(),
                               anew.effectiveRadiusMm().begin()));
        const MeanProfile mean = tables.meanProfile();
        const MeanProfile expected = anew.meanProfile();
        ASSERT_TRUE(
            std::equal(mean.samples().begin(), mean.samples().end(), expected.samples().begin()));
        ASSERT_TRUE(std::equal(tables.rangeTable().values().begin(),
                               tables.rangeTable().values().end(),
                               anew.rangeTable().values().begin()));
    }
}

} // namespace
} // namespace celadon::subedit
