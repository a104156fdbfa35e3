#include "app/plot/write_plot.h"

#include "app/plot/rasterize.h"
#include "app/plot/svg.h"
#include "renderer/output/image_io.h"
#include "subedit/atomic_file.h"
#include "subedit/errors.h"

#include <algorithm>
#include <cctype>
#include <string>

namespace celadon::plot {

namespace {

constexpr double kPixelsPerUnit = 2.0;

std::string lowerExtension(const std::filesystem::path& file) {
    std::string extension = file.extension().string();
    std::ranges::transform(extension, extension.begin(), [](char c) {
        return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    });
    return extension;
}

} // namespace

bool isPlotFile(const std::filesystem::path& file) {
    const std::string extension = lowerExtension(file);
    return extension == ".png" || extension == ".svg";
}

void writePlot(const std::filesystem::path& file, const Drawing& drawing) {
    if (!isPlotFile(file)) {
        throw UsageError("'" + file.string() + "'", "is no plot", "end it in .png or .svg");
    }
    if (lowerExtension(file) == ".svg") {
        writeFileAtomically(file, toSvg(drawing));
    } else {
        writeDisplayImage(file, rasterize(drawing, kPixelsPerUnit));
    }
}

} // namespace celadon::plot
