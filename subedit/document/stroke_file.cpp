#include "subedit/document/stroke_file.h"

#include "subedit/document/hex_text.h"
#include "subedit/document/json_reader.h"
#include "subedit/errors.h"
#include "subedit/fit/profile_fit.h"
#include "subedit/map/material_map.h"
#include "subedit/models/normalized_diffusion.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include <array>
#include <cmath>
#include <fstream>
#include <iterator>

namespace celadon::subedit {

namespace {

using nlohmann::json;

constexpr const char* kFormat = "celadon-strokes";
constexpr int kVersion = 1;
constexpr int kDeepest = 32;
constexpr double kLargestMap = 8192;

constexpr double kFarthestMm = 1e7;
constexpr Limits kAnywhere{-kFarthestMm, kFarthestMm};
constexpr Limits kUnit{0.0, 1.0};
constexpr Limits kPositiveUnit{0.0, 1.0, true};
constexpr Limits kLengthMm{1e-4, 1e6};
constexpr Limits kFactor{0.0, 1e4};
constexpr Limits kRangeFactor{0.01, 100.0};
constexpr Limits kLogP{-1e4, 40.0}; ///< raised to the floor below

// Reading.

class Reader {
public:
    Reader(const std::string& subject, const ProfileLookup& lookup)
        : mSubject(subject), mLookup(lookup) {}

    StrokeFile file(const json& document) const {
        const JsonReader root(mSubject, document, "");
        if (root.text("format") != kFormat) {
            root.fail("format", fmt::format("is not \"{}\"", kFormat), "is this a stroke file?");
        }
        static_cast<void>(root.number("version", {kVersion, kVersion}));
        StrokeFile file;
        if (root.has("surface")) {
            const JsonReader surface = root.object("surface");
            if (surface.has("model")) {
                file.surface.model = surface.text("model");
            } else if (surface.has("flatWidthMm")) {
                file.surface.flatWidthMm = surface.number("flatWidthMm", kLengthMm);
            }
            if (surface.has("texels")) {
                const glm::vec2 texels = surface.vec2("texels", {1.0, kLargestMap});
                file.surface.texels = glm::ivec2(texels);
                if (glm::vec2(*file.surface.texels) != texels) {
                    surface.fail("texels", "are not whole numbers");
                }
            }
            surface.finish();
        }
        root.forEach("commands", [&](const json& value, const std::string& pointer) {
            file.commands.push_back(command(value, pointer));
        });
        root.finish();
        return file;
    }

    EditCommand command(const json& value, const std::string& pointer) const {
        constexpr std::array<std::string_view, 5> kCommands{"apply", "stroke", "propagate", "stamp",
                                                            "select"};
        const JsonReader in(mSubject, value, pointer);
        EditCommand result;
        switch (in.choice("command", kCommands, "command")) {
        case 0:
            result = ApplyCommand{readOperator(in.object("operator"))};
            break;
        case 1:
            result =
                StrokeCommand{readOperator(in.object("operator")), brush(in), mirror(in), path(in)};
            break;
        case 2:
            result = PropagateCommand{readOperator(in.object("operator")), propagation(in)};
            break;
        case 3:
            result = StampCommand{readOperator(in.object("operator")), stamp(in)};
            break;
        default:
            result = selection(in);
        }
        in.finish();
        return result;
    }

private:
    EditOperator readOperator(const JsonReader& in) const {
        const std::size_t which = in.choice("name", kOperatorNames, "operator");
        EditOperator op = operatorAt(in, which);
        in.finish();
        return op;
    }

    EditOperator operatorAt(const JsonReader& in, std::size_t which) const {
        switch (which) {
        case 0:
            return ScaleAlbedo{in.vec3("factor", kFactor)};
        case 1:
            return SetAlbedo{in.vec3("albedo", kUnit)};
        case 2: {
            const Tint tint{in.vec3("color", kFactor), in.number("amount", kUnit, 1.0f)};
            if (tint.color == glm::vec3(0.0f)) {
                in.fail("color", "is black, which has no color");
            }
            return tint;
        }
        case 3:
            return ScaleRange{in.vec3("factor", kRangeFactor)};
        case 4:
            return SetRange{in.vec3("radiusMm", kLengthMm)};
        case 5:
            return SetShape{profile(in.object("curve"))};
        case 6:
            return Mix{profile(in.object("profile")), in.number("amount", kUnit, 1.0f)};
        case 7: {
            const Gradient gradient{profile(in.object("from")), profile(in.object("to")),
                                    in.vec3("fromMm", kAnywhere), in.vec3("toMm", kAnywhere)};
            if (gradient.fromMm == gradient.toMm) {
                in.fail("toMm", "is the same place as fromMm");
            }
            return gradient;
        }
        case 8:
            return Heterogeneity{in.number("amount", {-1.0, 4.0}),
                                 in.number("radiusMm", kLengthMm)};
        case 9:
            return Clone{placement(in)};
        default:
            return TransferPattern{placement(in), in.number("radiusMm", kLengthMm),
                                   in.number("strength", {0.0, 4.0}, 1.0f)};
        }
    }

    Placement placement(const JsonReader& in) const {
        return {place(in.object("from")), place(in.object("to")),
                in.number("angleDegrees", {-360.0, 360.0}, 0.0f)};
    }

    /// Knots, or albedo and range of normalized diffusion, or a texel of a material.
    StoredProfile profile(const JsonReader& in) const {
        StoredProfile result;
        if (in.has("material")) {
            const std::string material = in.text("material");
            const glm::vec2 uv = in.has("uv") ? in.vec2("uv", kUnit) : glm::vec2(0.5f);
            if (!mLookup) {
                in.fail("material", "cannot be looked up here", "give the profile's knots");
            }
            result = mLookup(material, uv);
        } else if (in.has("albedo")) {
            const glm::vec3 albedo = in.vec3("albedo", kUnit);
            const glm::vec3 radius = in.vec3("effectiveRadiusMm", kLengthMm);
            const double unitRadius = normalizedDiffusionRadius();
            RadialCurves curves;
            for (int c = 0; c < 3; ++c) {
                curves[static_cast<std::size_t>(c)] = normalizedDiffusionCurve(
                    static_cast<double>(albedo[c]), static_cast<double>(radius[c]) / unitRadius);
            }
            FitSettings settings;
            settings.segments = static_cast<int>(in.number("segments", {1.0, kMaxSegments}, 32.0f));
            const FittedProfile fitted = fitProfile(curves, settings);
            result = {fitted.segments, fitted.maxRadiusMm, fitted.logProfile};
        } else {
            result.maxRadiusMm = in.number("maxRadiusMm", kLengthMm);
            in.forEach("knots", [&](const json& value, const std::string& pointer) {
                if (!value.is_array() || value.size() != 3) {
                    throw InputError(fmt::format("{}, {}", mSubject, pointer),
                                     "is not three values of ln P");
                }
                for (std::size_t c = 0; c < 3; ++c) {
                    const double number = value[c].is_number() ? value[c].get<double>() : NAN;
                    if (!(number >= kLogP.least && number <= kLogP.most)) {
                        throw InputError(fmt::format("{}, {}/{}", mSubject, pointer, c),
                                         fmt::format("is {}, not a value of ln P up to {:g}",
                                                     value[c].dump(), kLogP.most));
                    }
                    result.logProfile.push_back(
                        std::max(static_cast<float>(number), kLogProfileFloor));
                }
            });
            result.segments = static_cast<int>(result.logProfile.size() / 3) - 1;
            if (result.segments < 1 || result.segments > kMaxSegments) {
                in.fail("knots", fmt::format("are {}", result.segments + 1),
                        fmt::format("2 to {} are possible", kMaxSegments + 1));
            }
        }
        in.finish();
        return result;
    }

    static Brush brush(const JsonReader& parent) {
        const JsonReader in = parent.object("brush");
        const Brush usual;
        const Brush result{in.number("radiusMm", kLengthMm),
                           in.number("hardness", kUnit, usual.hardness),
                           in.number("flow", kPositiveUnit, usual.flow),
                           in.number("opacity", kPositiveUnit, usual.opacity),
                           in.number("spacing", {0.02, 4.0}, usual.spacing)};
        in.finish();
        return result;
    }

    static Mirror mirror(const JsonReader& parent) {
        Mirror result;
        if (!parent.has("mirror")) {
            return result;
        }
        const JsonReader in = parent.object("mirror");
        for (const char axis : in.text("axes")) {
            if (axis < 'x' || axis > 'z') {
                in.fail("axes", fmt::format("holds '{}'", axis), "use letters of \"xyz\"");
            }
            result.axes[static_cast<std::size_t>(axis - 'x')] = true;
        }
        if (in.has("centerMm")) {
            result.centerMm = in.vec3("centerMm", kAnywhere);
        }
        in.finish();
        return result;
    }

    StrokePoint point(const JsonReader& in) const {
        StrokePoint result;
        if (in.has("uv")) {
            result.uv = in.vec2("uv", kUnit);
        } else {
            result.positionMm = in.vec3("positionMm", kAnywhere);
            if (in.has("normal")) {
                result.normal = in.vec3("normal", {-1e6, 1e6});
                const float length = glm::length(result.normal);
                if (!(length > 1e-6f)) {
                    in.fail("normal", "has no direction");
                }
                if (std::abs(length - 1.0f) > 1e-4f) { // what we write is left as it is
                    result.normal /= length;
                }
            }
        }
        return result;
    }

    StrokePoint place(const JsonReader& in) const {
        const StrokePoint result = point(in);
        in.finish();
        return result;
    }

    std::vector<StrokePoint> path(const JsonReader& parent) const {
        std::vector<StrokePoint> points;
        parent.forEach("path", [&](const json& value, const std::string& pointer) {
            const JsonReader in(mSubject, value, pointer);
            points.push_back(point(in));
            points.back().pressure = in.number("pressure", kUnit, 1.0f);
            points.back().isLifted = in.flag("lifted", false);
            in.finish();
        });
        return points;
    }

    Propagation propagation(const JsonReader& in) const {
        Propagation result;
        in.forEach("scribbles", [&](const json& value, const std::string& pointer) {
            const JsonReader scribble(mSubject, value, pointer);
            result.scribbles.push_back({brush(scribble), mirror(scribble), path(scribble),
                                        scribble.number("strength", kUnit, 1.0f)});
            scribble.finish();
        });
        result.similarity = in.number("similarity", kPositiveUnit, result.similarity);
        if (in.has("distanceMm")) {
            result.distanceMm = in.number("distanceMm", kLengthMm);
        }
        return result;
    }

    Stamp stamp(const JsonReader& in) const {
        Stamp result;
        result.at = place(in.object("at"));
        result.widthMm = in.number("widthMm", kLengthMm);
        result.angleDegrees = in.number("angleDegrees", {-360.0, 360.0}, 0.0f);
        const glm::vec2 pixels = in.vec2("pixels", {1.0, kLargestStamp});
        result.width = static_cast<int>(pixels.x);
        result.height = static_cast<int>(pixels.y);
        if (glm::vec2(result.width, result.height) != pixels) {
            in.fail("pixels", "are not whole numbers");
        }
        std::optional<std::vector<std::uint8_t>> weights = parseHex(in.text("weights"));
        if (!weights || weights->size() != static_cast<std::size_t>(result.width) *
                                               static_cast<std::size_t>(result.height)) {
            in.fail("weights", "are not two hexadecimal digits for each pixel");
        }
        result.weights = std::move(*weights);
        result.mirror = mirror(in);
        return result;
    }

    SelectCommand selection(const JsonReader& in) const {
        SelectCommand result;
        const std::size_t step = in.choice("step", kSelectionStepNames, "selection");
        if (step >= 3 && step <= 5 && in.has("mode")) {
            result.mode = static_cast<SelectMode>(in.choice("mode", kSelectModeNames, "mode"));
        }
        switch (step) {
        case 0:
            result.step = SelectAll{};
            break;
        case 1:
            result.step = SelectNone{};
            break;
        case 2:
            result.step = InvertSelection{};
            break;
        case 3:
            result.step = SelectStroke{brush(in), mirror(in), path(in)};
            break;
        case 4: {
            SelectSimilar similar{place(in.object("point")),
                                  in.number("tolerance", kPositiveUnit),
                                  in.number("softness", kUnit, 0.5f),
                                  {}};
            if (in.has("withinMm")) {
                similar.withinMm = in.number("withinMm", kLengthMm);
            }
            result.step = similar;
            break;
        }
        case 5:
            result.step = propagation(in);
            break;
        case 6:
            result.step = GrowSelection{in.number("distanceMm", kLengthMm)};
            break;
        case 7:
            result.step = ShrinkSelection{in.number("distanceMm", kLengthMm)};
            break;
        default:
            result.step = FeatherSelection{in.number("distanceMm", kLengthMm)};
        }
        return result;
    }

    const std::string& mSubject;
    const ProfileLookup& mLookup;
};

json parseText(const std::string& subject, std::string_view text) {
    const auto boundDepth = [&](int depth, json::parse_event_t, json&) {
        if (depth > kDeepest) { // values are also written, in messages, by recursion
            throw InputError(subject, fmt::format("is nested deeper than {} levels", kDeepest));
        }
        return true;
    };
    try {
        return json::parse(text, boundDepth);
    } catch (const json::exception& error) {
        // "[json.exception.parse_error.101] parse error at line 3, column 7: ..."
        std::string reason = error.what();
        if (const std::size_t bracket = reason.find("] "); bracket != std::string::npos) {
            reason.erase(0, bracket + 2);
        }
        throw InputError(subject, "is not JSON: " + reason);
    }
}

// Writing. A float becomes the double of the same value, which JSON carries in full.

double wide(float value) {
    return static_cast<double>(value);
}

json toJson(const glm::vec3& v) {
    return json::array({wide(v.x), wide(v.y), wide(v.z)});
}

json toJson(const StoredProfile& profile) {
    json knots = json::array();
    for (std::size_t i = 0; i + 2 < profile.logProfile.size(); i += 3) {
        knots.push_back(
            toJson({profile.logProfile[i], profile.logProfile[i + 1], profile.logProfile[i + 2]}));
    }
    return {{"maxRadiusMm", wide(profile.maxRadiusMm)}, {"knots", std::move(knots)}};
}

/// A place: of a point of a path all but what the hand did there.
json toJson(const StrokePoint& point) {
    json out = json::object();
    if (point.uv) {
        out["uv"] = json::array({wide(point.uv->x), wide(point.uv->y)});
    } else {
        out["positionMm"] = toJson(point.positionMm);
        if (point.normal != glm::vec3(0.0f)) {
            out["normal"] = toJson(point.normal);
        }
    }
    return out;
}

json toJson(const Brush& brush) {
    return {{"radiusMm", wide(brush.radiusMm)},
            {"hardness", wide(brush.hardness)},
            {"flow", wide(brush.flow)},
            {"opacity", wide(brush.opacity)},
            {"spacing", wide(brush.spacing)}};
}

void addMirror(json& out, const Mirror& mirror) {
    if (mirror != Mirror{}) {
        std::string axes;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            axes += mirror.axes[axis] ? std::string(1, "xyz"[axis]) : "";
        }
        out["mirror"] = {{"axes", axes}, {"centerMm", toJson(mirror.centerMm)}};
    }
}

/// Brush, mirror and path, as members of `out`.
void addStroke(json& out, const Brush& brush, const Mirror& mirror,
               const std::vector<StrokePoint>& path) {
    out["brush"] = toJson(brush);
    addMirror(out, mirror);
    json points = json::array();
    for (const StrokePoint& point : path) {
        json& last = points.emplace_back(toJson(point));
        if (point.pressure != 1.0f) {
            last["pressure"] = wide(point.pressure);
        }
        if (point.isLifted) {
            last["lifted"] = true;
        }
    }
    out["path"] = std::move(points);
}

void addPropagation(json& out, const Propagation& propagation) {
    json scribbles = json::array();
    for (const Scribble& scribble : propagation.scribbles) {
        json s = {{"strength", wide(scribble.strength)}};
        addStroke(s, scribble.brush, scribble.mirror, scribble.path);
        scribbles.push_back(std::move(s));
    }
    out["scribbles"] = std::move(scribbles);
    out["similarity"] = wide(propagation.similarity);
    if (propagation.distanceMm) {
        out["distanceMm"] = wide(*propagation.distanceMm);
    }
}

void addPlacement(json& out, const Placement& placement) {
    out["from"] = toJson(placement.from);
    out["to"] = toJson(placement.to);
    out["angleDegrees"] = wide(placement.angleDegrees);
}

struct OperatorWriter {
    json& out;
    void operator()(const ScaleAlbedo& op) const { out["factor"] = toJson(op.factor); }
    void operator()(const SetAlbedo& op) const { out["albedo"] = toJson(op.albedo); }
    void operator()(const Tint& op) const {
        out["color"] = toJson(op.color);
        out["amount"] = wide(op.amount);
    }
    void operator()(const ScaleRange& op) const { out["factor"] = toJson(op.factor); }
    void operator()(const SetRange& op) const { out["radiusMm"] = toJson(op.radiusMm); }
    void operator()(const SetShape& op) const { out["curve"] = toJson(op.curve); }
    void operator()(const Mix& op) const {
        out["profile"] = toJson(op.profile);
        out["amount"] = wide(op.amount);
    }
    void operator()(const Gradient& op) const {
        out["from"] = toJson(op.from);
        out["to"] = toJson(op.to);
        out["fromMm"] = toJson(op.fromMm);
        out["toMm"] = toJson(op.toMm);
    }
    void operator()(const Heterogeneity& op) const {
        out["amount"] = wide(op.amount);
        out["radiusMm"] = wide(op.radiusMm);
    }
    void operator()(const Clone& op) const { addPlacement(out, op.placement); }
    void operator()(const TransferPattern& op) const {
        addPlacement(out, op.placement);
        out["radiusMm"] = wide(op.radiusMm);
        out["strength"] = wide(op.strength);
    }
};

json toJson(const EditOperator& op) {
    json out = {{"name", operatorName(op)}};
    std::visit(OperatorWriter{out}, op);
    return out;
}

struct StepWriter {
    json& out;
    void operator()(const SelectAll&) const {}
    void operator()(const SelectNone&) const {}
    void operator()(const InvertSelection&) const {}
    void operator()(const SelectStroke& s) const { addStroke(out, s.brush, s.mirror, s.path); }
    void operator()(const SelectSimilar& s) const {
        out["point"] = toJson(s.point);
        out["tolerance"] = wide(s.tolerance);
        out["softness"] = wide(s.softness);
        if (s.withinMm) {
            out["withinMm"] = wide(*s.withinMm);
        }
    }
    void operator()(const Propagation& s) const { addPropagation(out, s); }
    void operator()(const GrowSelection& s) const { out["distanceMm"] = wide(s.distanceMm); }
    void operator()(const ShrinkSelection& s) const { out["distanceMm"] = wide(s.distanceMm); }
    void operator()(const FeatherSelection& s) const { out["distanceMm"] = wide(s.distanceMm); }
};

struct CommandWriter {
    json& out;
    void operator()(const ApplyCommand& c) const {
        out["command"] = "apply";
        out["operator"] = toJson(c.op);
    }
    void operator()(const StrokeCommand& c) const {
        out["command"] = "stroke";
        out["operator"] = toJson(c.op);
        addStroke(out, c.brush, c.mirror, c.path);
    }
    void operator()(const PropagateCommand& c) const {
        out["command"] = "propagate";
        out["operator"] = toJson(c.op);
        addPropagation(out, c.propagation);
    }
    void operator()(const StampCommand& c) const {
        out["command"] = "stamp";
        out["operator"] = toJson(c.op);
        out["at"] = toJson(c.stamp.at);
        out["widthMm"] = wide(c.stamp.widthMm);
        out["angleDegrees"] = wide(c.stamp.angleDegrees);
        out["pixels"] = json::array({c.stamp.width, c.stamp.height});
        out["weights"] = hexText(c.stamp.weights);
        addMirror(out, c.stamp.mirror);
    }
    void operator()(const SelectCommand& c) const {
        out["command"] = "select";
        out["step"] = selectionStepName(c.step);
        if (c.mode != SelectMode::Replace) {
            out["mode"] = kSelectModeNames[static_cast<std::size_t>(c.mode)];
        }
        std::visit(StepWriter{out}, c.step);
    }
};

json toJson(const EditCommand& command) {
    json out = json::object();
    std::visit(CommandWriter{out}, command);
    return out;
}

} // namespace

StrokeFile parseStrokeFile(const std::string& subject, std::string_view text,
                           const ProfileLookup& lookup) {
    return Reader(subject, lookup).file(parseText(subject, text));
}

StrokeFile readStrokeFile(const std::filesystem::path& file, const ProfileLookup& lookup) {
    const std::string subject = fmt::format("'{}'", file.string());
    std::error_code error;
    if (!std::filesystem::exists(file, error)) {
        throw InputError(subject, "no such file");
    }
    std::ifstream stream(file, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    if (!stream || std::filesystem::is_directory(file, error)) {
        throw InputError(subject, "cannot be read");
    }
    return parseStrokeFile(subject, text, lookup);
}

std::string strokeFileText(const StrokeFile& file) {
    json surface = json::object();
    if (file.surface.model) {
        surface["model"] = *file.surface.model;
    } else {
        surface["flatWidthMm"] = wide(file.surface.flatWidthMm);
    }
    if (file.surface.texels) {
        surface["texels"] = json::array({file.surface.texels->x, file.surface.texels->y});
    }
    // A command a line: readable, and small changes are small differences.
    std::string text = fmt::format("{{\"format\": \"{}\", \"version\": {}, \"surface\": {},\n"
                                   "\"commands\": [",
                                   kFormat, kVersion, surface.dump());
    for (std::size_t i = 0; i < file.commands.size(); ++i) {
        text += (i > 0 ? ",\n" : "\n") + commandText(file.commands[i]);
    }
    return text + "\n]}\n";
}

std::string commandText(const EditCommand& command) {
    return toJson(command).dump();
}

EditCommand parseCommand(const std::string& subject, std::string_view text,
                         const ProfileLookup& lookup) {
    return Reader(subject, lookup).command(parseText(subject, text), "");
}

} // namespace celadon::subedit
