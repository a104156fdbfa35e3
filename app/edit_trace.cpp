#include "app/edit_trace.h"

#include "app/plot/chart.h"
#include "app/plot/write_plot.h"
#include "subedit/atomic_file.h"
#include "subedit/errors.h"

#include <fmt/format.h>

#include <array>
#include <string>
#include <utility>

namespace celadon::app {

namespace {

std::string table(const std::vector<ui::TracePoint>& points) {
    std::string text = "seconds,command_ms,picture_ms,processor_ms,memory_mb\n";
    for (const ui::TracePoint& p : points) {
        text += fmt::format("{:.3f},{:.3f},{:.3f},{:.3f},{:.2f}\n", p.seconds, p.commandMs,
                            p.pictureMs, p.processorMs, p.memoryMb);
    }
    return text;
}

plot::Drawing figure(const std::vector<ui::TracePoint>& points) {
    plot::Series command, picture, processor, memory;
    command.label = "map, tables and undo";
    command.color = plot::seriesColor(0);
    picture.label = "until its light is on screen";
    picture.color = plot::seriesColor(1);
    processor.label = "processor time, all cores";
    processor.color = plot::seriesColor(3);
    memory.color = plot::seriesColor(2);
    for (const ui::TracePoint& p : points) {
        command.points.emplace_back(p.seconds, p.commandMs);
        picture.points.emplace_back(p.seconds, p.commandMs + p.pictureMs);
        processor.points.emplace_back(p.seconds, p.processorMs);
        memory.points.emplace_back(p.seconds, p.memoryMb);
    }
    plot::LineChart times;
    times.title = "Time of a stroke";
    times.x.label = "time of the session [s]";
    times.y.label = "milliseconds";
    times.y.from = 0.0;
    times.series = {std::move(command), std::move(picture), std::move(processor)};
    plot::LineChart sizes;
    sizes.title = "Resident memory";
    sizes.x.label = times.x.label;
    sizes.y.label = "MB";
    sizes.y.from = 0.0;
    sizes.series = {std::move(memory)};
    sizes.legend = plot::Legend::None;
    return plot::placeBeside({plot::drawChart(times), plot::drawChart(sizes)});
}

} // namespace

EditTrace::EditTrace(std::filesystem::path file) : mFile(std::move(file)) {
    if (!plot::isPlotFile(mFile)) {
        throw UsageError(fmt::format("--trace '{}'", mFile.string()), "is no figure",
                         "let it end in .svg or .png; the numbers go into a .csv beside it");
    }
    checkWritable(mFile);
}

void EditTrace::write() const {
    std::filesystem::path numbers = mFile;
    writeFileAtomically(numbers.replace_extension(".csv"), std::string_view(table(mPoints)));
    plot::writePlot(mFile, figure(mPoints));
}

} // namespace celadon::app
