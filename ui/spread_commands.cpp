// Commands that spread an edit beyond a brush: scribbles that are propagated, and stamped pictures.
// What they do to a material is recorded as the edit that it came to (paint_commands.cpp).
#include "renderer/output/image_io.h"
#include "renderer/output/tone_map.h"
#include "subedit/errors.h"
#include "subedit/select/stamp.h"
#include "ui/session.h"

#include <fmt/format.h>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>

namespace celadon::ui {

namespace {

constexpr int kStampPixels = 192; ///< on the longer side: more than a brush's texels

/// Luminance (Rec. 709) as one sees it, the picture made smaller by whole boxes. Colors come
/// premultiplied: what is transparent does not stamp.
StampImage readStamp(const std::filesystem::path& file) {
    const ReadImage read = readImage(file);
    const FloatImage& image = read.image;
    const int box =
        std::max(1, (std::max(image.width, image.height) + kStampPixels - 1) / kStampPixels);
    const auto channel = [&](const char* name) { return image.channelIndex(name); };
    const int gray = channel("Y");
    const int red = channel("R"), green = channel("G"), blue = channel("B");
    if (gray < 0 && (red < 0 || green < 0 || blue < 0)) {
        throw InputError(fmt::format("'{}'", file.string()), "holds neither colors nor gray");
    }
    StampImage stamp{
        file.stem().string(), std::max(1, image.width / box), std::max(1, image.height / box), {}};
    for (int y = 0; y < stamp.height; ++y) {
        for (int x = 0; x < stamp.width; ++x) {
            float sum = 0.0f;
            int count = 0;
            for (int j = y * box; j < std::min((y + 1) * box, image.height); ++j) {
                for (int i = x * box; i < std::min((x + 1) * box, image.width); ++i) {
                    sum += gray >= 0
                               ? image.at(i, j, gray)
                               : 0.2126f * image.at(i, j, red) + 0.7152f * image.at(i, j, green) +
                                     0.0722f * image.at(i, j, blue);
                    ++count;
                }
            }
            const float weight = encodeSrgb(sum / static_cast<float>(count)); // of what one sees
            stamp.weights.push_back(static_cast<std::uint8_t>(std::lround(255.0f * weight)));
        }
    }
    return stamp;
}

/// Points as [x, y, z, nx, ny, nz], mm; `lifted` numbers those that come after a gap.
std::vector<subedit::StrokePoint> pathOf(const Arguments& a) {
    std::vector<subedit::StrokePoint> path;
    const std::vector<double> v = a.numbers("path");
    for (std::size_t i = 0; i + 5 < v.size(); i += 6) {
        subedit::StrokePoint point;
        point.positionMm = glm::vec3(v[i], v[i + 1], v[i + 2]);
        point.normal = glm::vec3(v[i + 3], v[i + 4], v[i + 5]);
        path.push_back(point);
    }
    if (a.has("lifted")) {
        for (const double number : a.numbers("lifted")) {
            if (!(number >= 0.0 && number < static_cast<double>(path.size()))) {
                throw UsageError("scribble", "a lifted point is none of its path");
            }
            path[static_cast<std::size_t>(number)].isLifted = true;
        }
    }
    return path;
}

void changePropagation(subedit::Propagation& propagation, const Arguments& a) {
    if (a.has("similarity")) {
        propagation.similarity = static_cast<float>(a.numberWithin("similarity", 1e-3, 1.0));
    }
    if (a.has("distance")) { // 0: it does not matter
        const double distance = a.numberWithin("distance", 0.0, 1e4);
        propagation.distanceMm =
            distance > 0.0 ? std::optional(static_cast<float>(distance)) : std::nullopt;
    }
}

void addScribbles(Session& session) {
    Dispatcher& commands = session.dispatcher();
    commands.add(
        "scribble.add",
        "A rough stroke for propagation: path [x,y,z,nx,ny,nz, ...] in mm, numbers of points "
        "lifted over a gap, strength 1, or 0 for what is to be left alone",
        [&session](const Arguments& a) {
            subedit::Scribble scribble;
            scribble.brush = session.paint.brush;
            scribble.path = pathOf(a);
            scribble.mirror = session.mirror();
            scribble.strength = static_cast<float>(a.numberWithin("strength", 0.0, 1.0));
            if (scribble.path.empty()) {
                throw UsageError("scribble", "has no points");
            }
            session.paint.propagation.scribbles.push_back(std::move(scribble));
        });
    commands.add("scribble.clear", "Takes the scribbles away",
                 [&session](const Arguments&) { session.paint.propagation.scribbles.clear(); });
    commands.add(
        "scribble.change",
        "Similarity at which propagation falls to 1/e, and distance in mm (0: any)",
        [&session](const Arguments& a) { changePropagation(session.paint.propagation, a); });
    commands.addLong(
        "scribble.apply",
        "Spreads the operator, or with select the selection, from the scribbles, and takes "
        "them away",
        [&session](const Arguments& a) {
            const subedit::Propagation& propagation = session.paint.propagation;
            if (propagation.scribbles.empty()) {
                throw UsageError("propagation", "there are no scribbles",
                                 "draw some over what you mean");
            }
            if (a.flag("select", false)) {
                session.edit(subedit::SelectCommand{propagation, subedit::SelectMode::Replace});
            } else {
                session.edit(
                    subedit::PropagateCommand{makeOperator(session.paint, false), propagation});
            }
            session.execute({"scribble.clear"}); // they have done their work
        });
}

void addStamps(Session& session) {
    Dispatcher& commands = session.dispatcher();
    commands.add("stamp.open", "Takes a picture into the hand: its light parts stamp",
                 [&session](const Arguments& a) {
                     session.paint.stamp = readStamp(a.text("file"));
                     session.paint.tool = Tool::Stamp;
                 });
    commands.add("stamp.change", "Angle in degrees, counter-clockwise",
                 [&session](const Arguments& a) {
                     session.paint.stampAngleDegrees =
                         static_cast<float>(a.numberWithin("angle", -180.0, 180.0));
                 });
    commands.add(
        "stamp.place", "Applies the operator as the picture says, at position and normal",
        [&session](const Arguments& a) {
            const StampImage& image = session.paint.stamp;
            if (!image.isSet()) {
                throw UsageError("stamp", "there is no picture in the hand", "open one first");
            }
            subedit::Stamp stamp;
            stamp.at.positionMm = glm::vec3(a.vector3("position"));
            stamp.at.normal = glm::vec3(a.vector3("normal"));
            stamp.widthMm = 2.0f * session.paint.brush.radiusMm;
            stamp.angleDegrees = session.paint.stampAngleDegrees;
            stamp.width = image.width;
            stamp.height = image.height;
            stamp.weights = image.weights;
            stamp.mirror = session.mirror();
            session.edit(subedit::StampCommand{
                makeOperator(session.paint, a.flag("inverted", false)), std::move(stamp)});
        },
        false);
}

} // namespace

void addSpreadCommands(Session& session) {
    addScribbles(session);
    addStamps(session);
}

} // namespace celadon::ui
