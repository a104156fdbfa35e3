// Commands about deformers, their control points, handles and keys. Lengths are in model units as
// in files (renderer/scene/README.md), except where they say "Mm". What has keys changes at
// `seconds`, or at the moment that is shown; "continues" makes one step of a change and the one
// before.
#include "renderer/scene/load_bytes.h"
#include "renderer/scene/load_deformers.h"
#include "subedit/atomic_file.h"
#include "subedit/errors.h"
#include "ui/session.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace celadon::ui {

namespace {

constexpr double kMost = 1e6; ///< of any length, in whichever unit
constexpr int kMostControls = 1 << 20;

void requireWorld(const Session& session) {
    if (!session.hasWorld()) {
        throw UsageError("deformers", "no model is open", "open one first");
    }
}

int deformerIndex(const Session& session, const Arguments& a) {
    const int count = static_cast<int>(session.motion.now.deformers.size());
    if (count == 0) {
        throw UsageError("deformers", "there is none", "add one");
    }
    return a.integerWithin("deformer", 0, count - 1);
}

double momentOf(const Session& session, const Arguments& a) {
    return a.has("seconds") ? a.numberWithin("seconds", 0.0, kMost) : session.motion.now.seconds;
}

/// A change of one deformer that is made whole or not at all.
void change(Session& session, int index, const Arguments& a,
            const std::function<void(AnimatedDeformer&)>& edit) {
    MotionSetting next = session.motion.now;
    AnimatedDeformer& deformer = next.deformers[static_cast<std::size_t>(index)];
    edit(deformer);
    const std::string title = deformerName(deformer.kind);
    session.changeMotion(std::move(next), title, a.flag("continues", false));
}

/// A value: of the key at that time where there are keys, else the constant.
void setValue(KeyedNumbers& numbers, double seconds, std::span<const double> value) {
    if (numbers.isKeyed()) {
        numbers.setKey(seconds, value);
    } else {
        std::copy(value.begin(), value.end(), numbers.values.begin());
    }
}
void setValue(KeyedNumbers& numbers, double seconds, const glm::dvec3& value) {
    setValue(numbers, seconds, std::span(&value.x, 3));
}

glm::dvec3 boundedVector(const Arguments& a, const char* name) {
    const glm::dvec3 v = a.vector3(name);
    if (!(std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}) <= kMost)) {
        throw UsageError(name, "is too large");
    }
    return v;
}

Deformer::Kind kindOf(const Arguments& a) {
    const std::string type = a.text("type");
    for (int k = 0; k < static_cast<int>(Deformer::Kind::Handles); ++k) {
        if (type == deformerName(static_cast<Deformer::Kind>(k))) {
            return static_cast<Deformer::Kind>(k);
        }
    }
    throw UsageError("deform.add", fmt::format("there is no '{}'", type),
                     "choose twist, bend, taper, wave, inflate or lattice; handles are added one "
                     "by one");
}

/// One that shows what it does at once.
AnimatedDeformer newDeformer(Deformer::Kind kind, double diameterMm) {
    Deformer deformer;
    deformer.kind = kind;
    switch (kind) {
    case Deformer::Kind::Twist:
        deformer.amount = 45.0;
        break;
    case Deformer::Kind::Bend:
        deformer.amount = 30.0;
        break;
    case Deformer::Kind::Taper:
        deformer.amount = 0.6;
        break;
    case Deformer::Kind::Wave:
        deformer.amount = 0.03 * diameterMm;
        deformer.wavelengthMm = 0.4 * diameterMm;
        break;
    case Deformer::Kind::Inflate:
        deformer.amount = 0.02 * diameterMm;
        break;
    case Deformer::Kind::Lattice:
    case Deformer::Kind::Handles:
        break;
    }
    return deformer;
}

void addDeformer(Session& session, const Arguments& a) {
    requireWorld(session);
    const Deformer::Kind kind = kindOf(a);
    MotionSetting next = session.motion.now;
    next.deformers.push_back(newDeformer(kind, 2.0 * session.world().scatteringSphere.radius));
    const int last = static_cast<int>(next.deformers.size()) - 1;
    session.changeMotion(std::move(next), fmt::format("add {}", deformerName(kind)));
    session.chooseDeformer(last);
}

void removeDeformer(Session& session, const Arguments& a) {
    MotionSetting next = session.motion.now;
    const int index = deformerIndex(session, a);
    const auto gone = next.deformers.begin() + index;
    const std::string title = fmt::format("remove {}", deformerName(gone->kind));
    next.deformers.erase(gone);
    session.changeMotion(std::move(next), title);
    session.chooseDeformer(-1);
}

void orderDeformer(Session& session, const Arguments& a) {
    MotionSetting next = session.motion.now;
    const int from = deformerIndex(session, a);
    const int to = a.integerWithin("to", 0, static_cast<int>(next.deformers.size()) - 1);
    AnimatedDeformer deformer = std::move(next.deformers[static_cast<std::size_t>(from)]);
    next.deformers.erase(next.deformers.begin() + from);
    next.deformers.insert(next.deformers.begin() + to, std::move(deformer));
    session.changeMotion(std::move(next), "order of deformers");
    session.chooseDeformer(to);
}

void replaceStack(Session& session, const Arguments& a) {
    requireWorld(session);
    const nlohmann::json object{{"deformers", a.value("deformers")}};
    MotionSetting next = session.motion.now;
    next.deformers = loaders::deformersOf(loaders::JsonElement("the command", object, ""));
    session.changeMotion(std::move(next), "open deformers");
    session.chooseDeformer(-1);
}

void changeAmounts(const Session& session, AnimatedDeformer& deformer, const Arguments& a) {
    const double seconds = momentOf(session, a);
    deformer.isOn = a.flag("on", deformer.isOn);
    if (a.has("amount")) {
        const double least = deformer.kind == Deformer::Kind::Taper ? 0.0 : -kMost;
        const double amount = a.numberWithin("amount", least, kMost);
        setValue(deformer.amount, seconds, std::span(&amount, 1));
    }
    if (a.has("wavelengthMm")) {
        const double wavelength = a.numberWithin("wavelengthMm", 1e-6, kMost);
        setValue(deformer.wavelengthMm, seconds, std::span(&wavelength, 1));
    }
    if (a.has("axis")) {
        deformer.axis = a.integerWithin("axis", 0, 2);
    }
    if (a.has("range")) {
        const glm::dvec2 range = a.vector2("range");
        if (!(range.x < range.y)) {
            throw UsageError("range", "does not run from low to high");
        }
        deformer.range = range;
        if (range == glm::dvec2(0.0, 1.0)) {
            deformer.range.reset(); // all of it, and on beyond
        }
    }
    if (a.has("size")) { // another grid: its points begin at rest
        const glm::dvec3 size = a.vector3("size");
        for (int k = 0; k < 3; ++k) {
            if (size[k] != std::floor(size[k]) || size[k] < 2 || size[k] > kMaxLatticePoints) {
                throw UsageError(
                    "size", fmt::format("holds something other than 2 to {}", kMaxLatticePoints));
            }
        }
        deformer.latticeSize = glm::ivec3(size);
        deformer.moves.clear();
    }
}

void movePoint(const Session& session, AnimatedDeformer& deformer, const Arguments& a) {
    if (deformer.kind != Deformer::Kind::Lattice) {
        throw UsageError("deform.point", "the deformer is no lattice");
    }
    const glm::dvec3 given = a.vector3("point");
    const glm::ivec3 point(given);
    if (glm::dvec3(point) != given || glm::any(glm::lessThan(point, glm::ivec3(0))) ||
        glm::any(glm::greaterThanEqual(point, deformer.latticeSize))) {
        throw UsageError("deform.point", "the lattice has no such point");
    }
    const auto found = std::find_if(deformer.moves.begin(), deformer.moves.end(),
                                    [&](const LatticeMove& move) { return move.point == point; });
    LatticeMove& move = found != deformer.moves.end()
                            ? *found
                            : deformer.moves.emplace_back(LatticeMove{.point = point});
    setValue(move.by, momentOf(session, a), boundedVector(a, "by"));
}

int handlesIndex(const Session& session) {
    const DeformerStack& stack = session.motion.now.deformers;
    const auto found = std::find_if(stack.begin(), stack.end(), [](const auto& deformer) {
        return deformer.kind == Deformer::Kind::Handles;
    });
    return found == stack.end() ? -1 : static_cast<int>(found - stack.begin());
}

void addHandle(Session& session, const Arguments& a) {
    requireWorld(session);
    Handle handle;
    handle.at = boundedVector(a, "at");
    handle.radius = a.numberWithin("radius", 0.0, kMost);
    MotionSetting next = session.motion.now;
    int index = handlesIndex(session);
    if (index < 0) {
        index = static_cast<int>(next.deformers.size());
        next.deformers.emplace_back().kind = Deformer::Kind::Handles;
    }
    std::vector<Handle>& handles = next.deformers[static_cast<std::size_t>(index)].handles;
    handles.push_back(std::move(handle));
    const int control = static_cast<int>(handles.size()) - 1;
    session.changeMotion(std::move(next), "add handle");
    session.chooseDeformer(index, control);
}

struct HandlePlace {
    int deformer = 0;
    std::size_t handle = 0;
};
/// @throws UsageError without such a handle
HandlePlace handleOf(const Session& session, const Arguments& a) {
    const int index = handlesIndex(session);
    if (index < 0) {
        throw UsageError("handles", "there is none", "add one");
    }
    const auto& handles = session.motion.now.deformers[static_cast<std::size_t>(index)].handles;
    return {index, static_cast<std::size_t>(
                       a.integerWithin("handle", 0, static_cast<int>(handles.size()) - 1))};
}

void changeHandle(Session& session, const Arguments& a) {
    const HandlePlace place = handleOf(session, a);
    const double seconds = momentOf(session, a);
    change(session, place.deformer, a, [&](AnimatedDeformer& deformer) {
        Handle& handle = deformer.handles[place.handle];
        if (a.has("move")) {
            setValue(handle.move, seconds, boundedVector(a, "move"));
        }
        if (a.has("turnDegrees")) {
            setValue(handle.turnDegrees, seconds, boundedVector(a, "turnDegrees"));
        }
        if (a.has("radius")) {
            handle.radius = a.numberWithin("radius", 0.0, kMost);
        }
    });
}

void removeHandle(Session& session, const Arguments& a) {
    const HandlePlace place = handleOf(session, a);
    MotionSetting next = session.motion.now;
    std::vector<Handle>& handles = next.deformers[static_cast<std::size_t>(place.deformer)].handles;
    handles.erase(handles.begin() + static_cast<std::ptrdiff_t>(place.handle));
    const bool isLast = handles.empty();
    if (isLast) {
        next.deformers.erase(next.deformers.begin() + place.deformer);
    }
    session.changeMotion(std::move(next), "remove handle");
    session.chooseDeformer(isLast ? -1 : place.deformer);
}

/// Whatever of a deformer may have keys: its amounts, or what moves one of its controls.
std::vector<KeyedNumbers*> keyedParts(AnimatedDeformer& deformer, int control) {
    if (deformer.kind == Deformer::Kind::Handles) {
        if (control < 0 || control >= static_cast<int>(deformer.handles.size())) {
            throw UsageError("deform.key", "no handle is chosen", "choose one");
        }
        Handle& handle = deformer.handles[static_cast<std::size_t>(control)];
        return {&handle.move, &handle.turnDegrees};
    }
    if (deformer.kind == Deformer::Kind::Lattice) { // the whole shape, as a pose of it
        std::vector<KeyedNumbers*> parts;
        for (LatticeMove& move : deformer.moves) {
            parts.push_back(&move.by);
        }
        return parts;
    }
    if (deformer.kind == Deformer::Kind::Wave) {
        return {&deformer.amount, &deformer.wavelengthMm};
    }
    return {&deformer.amount};
}

int controlOf(const Arguments& a) {
    return a.has("control") ? a.integerWithin("control", -1, kMostControls) : -1;
}

void setKey(Session& session, const Arguments& a) {
    const bool isSet = a.flag("on", true);
    const double seconds = momentOf(session, a);
    change(session, deformerIndex(session, a), a, [&](AnimatedDeformer& deformer) {
        for (KeyedNumbers* const part : keyedParts(deformer, controlOf(a))) {
            if (isSet) {
                std::vector<double> value(part->components);
                part->sample(seconds, value);
                part->setKey(seconds, value);
                continue;
            }
            const auto key = std::find(part->times.begin(), part->times.end(), seconds);
            if (key != part->times.end()) {
                part->removeKey(static_cast<std::size_t>(key - part->times.begin()));
            }
        }
    });
}

void setInterpolation(Session& session, const Arguments& a) {
    constexpr std::array kWords{"step", "linear", "cubic"};
    const std::string word = a.text("name");
    const auto found = std::find(kWords.begin(), kWords.end(), word);
    if (found == kWords.end()) {
        throw UsageError("deform.interpolation", fmt::format("there is no '{}'", word),
                         "choose step, linear or cubic");
    }
    change(session, deformerIndex(session, a), a, [&](AnimatedDeformer& deformer) {
        for (KeyedNumbers* const part : keyedParts(deformer, controlOf(a))) {
            part->interpolation = static_cast<Interpolation>(found - kWords.begin());
        }
    });
}

void saveDeformers(Session& session, const std::filesystem::path& file) {
    requireWorld(session);
    const DeformerStack& stack = session.motion.now.deformers;
    const std::filesystem::path model = session.opened().model;
    if (file.extension() == ".json") {
        writeFileAtomically(file, loaders::deformersJson(stack).dump(1) + "\n");
    } else if (file.extension() == model.extension() &&
               (file.extension() == ".glb" || file.extension() == ".gltf")) {
        writeFileAtomically(file,
                            loaders::gltfWithDeformers(model, loaders::readFile(model), stack));
    } else {
        throw UsageError(fmt::format("'{}'", file.string()),
                         "deformers are saved in a .json, or in a copy of the glTF that is open",
                         "choose .json");
    }
    session.markDeformersSaved();
    session.notify(Notice::Kind::Info, fmt::format("Saved '{}'", file.string()));
}

void select(Session& session, const Arguments& a) {
    const int index = deformerIndex(session, a);
    session.chooseDeformer(index, controlOf(a));
}

} // namespace

void addDeformCommands(Session& session) {
    Dispatcher& commands = session.dispatcher();
    using Act = void (*)(Session&, const Arguments&);
    const auto add = [&](const char* name, const char* summary, Act act, bool isRecorded = true) {
        commands.add(
            name, summary, [&session, act](const Arguments& a) { act(session, a); }, isRecorded);
    };
    add("deform.add", "Adds twist, bend, taper, wave, inflate or lattice at the end", addDeformer);
    add("deform.remove", "Takes a deformer out of the list", removeDeformer);
    add("deform.order", "Moves a deformer to another place in the list", orderDeformer);
    add("deform.stack", "Replaces all deformers by those of a file's \"deformers\"", replaceStack);
    add("deform.change", "Amount, wavelengthMm, axis (0 to 2), range, on; size of a lattice",
        [](Session& s, const Arguments& a) {
            change(s, deformerIndex(s, a), a, [&](AnimatedDeformer& d) { changeAmounts(s, d, a); });
        });
    add("deform.point", "Moves a control point of a lattice by model units from rest",
        [](Session& s, const Arguments& a) {
            change(s, deformerIndex(s, a), a, [&](AnimatedDeformer& d) { movePoint(s, d, a); });
        });
    commands.addLong(
        "deform.handle.add", "Adds a handle at a point of the rest shape, with a radius",
        [&session](const Arguments& a) { addHandle(session, a); }, true);
    add("deform.handle.change", "Moves or turns a handle, or gives it another radius",
        changeHandle);
    add("deform.handle.remove", "Takes a handle away", removeHandle);
    add("deform.key", "Sets a key at a moment, or takes it away (on: false)", setKey);
    add("deform.interpolation", "Between keys: step, linear, cubic", setInterpolation);
    add("deform.save", "Writes the deformers to a .json, or with a copy of the open glTF",
        [](Session& s, const Arguments& a) { saveDeformers(s, a.text("file")); });
    add("deform.select", "Chooses the deformer, and its control, that the panel shows", select,
        false);
}

} // namespace celadon::ui
