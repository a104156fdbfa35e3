#include "renderer/scene/atlas.h"

#include "renderer/scene/atlas_pack.h"
#include "renderer/scene/atlas_partition.h"
#include "subedit/assert.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace celadon {
namespace {

/// The corner of a triangle in the map: a vertex of a chart.
struct ChartVertex {
    int number = -1; ///< over all charts
    glm::vec2 uv{0.0f};
};

/// v runs down, so a front face appears in the map as it is seen, not mirrored.
glm::vec2 toUv(const atlas::Placement& placement, const Eigen::Vector2d& p) {
    const Eigen::Vector2d q = placement.linear * p + placement.offset;
    return {std::clamp(static_cast<float>(q.x()), 0.0f, 1.0f),
            std::clamp(static_cast<float>(1.0 - q.y()), 0.0f, 1.0f)};
}

std::vector<atlas::Outline> outlinesOf(const std::vector<atlas::Chart>& charts) {
    std::vector<atlas::Outline> outlines(charts.size());
    for (std::size_t c = 0; c < charts.size(); ++c) {
        outlines[c].area = charts[c].area;
        for (const std::vector<int>& loop : charts[c].mesh.loops) {
            std::vector<Eigen::Vector2d>& points = outlines[c].loops.emplace_back();
            points.reserve(loop.size());
            for (const int v : loop) {
                points.push_back(charts[c].uv[v]);
            }
        }
    }
    return outlines;
}

/// Builds the per-mesh arrays: a vertex of the input becomes one per chart vertex that it is seen
/// as.
class AtlasWriter {
public:
    AtlasWriter(std::span<const Mesh* const> meshes, const atlas::Surface& surface,
                const std::vector<atlas::Chart>& charts, const atlas::Packing& packing) {
        mCorners.resize(meshes.size());
        mCharts.resize(meshes.size());
        for (std::size_t m = 0; m < meshes.size(); ++m) {
            mCorners[m].resize(meshes[m]->indices.size());
            mCharts[m].resize(meshes[m]->triangleCount(), 0);
        }
        std::vector<ChartVertex> atVertex(surface.positions.size()); // any chart's view of it
        std::vector<int> chartAtVertex(surface.positions.size(), 0);
        int base = 0;
        for (std::size_t c = 0; c < charts.size(); ++c) {
            const atlas::ChartMesh& mesh = charts[c].mesh;
            for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
                const atlas::SourceTriangle& source = surface.sources[mesh.triangles[t]];
                mCharts[source.mesh][source.triangle] = static_cast<std::uint32_t>(c);
                for (int k = 0; k < 3; ++k) {
                    const int local = mesh.corners[t][k];
                    const ChartVertex vertex{base + local,
                                             toUv(packing.placements[c], charts[c].uv[local])};
                    mCorners[source.mesh][3 * source.triangle + k] = vertex;
                    atVertex[mesh.surfaceVertices[local]] = vertex;
                    chartAtVertex[mesh.surfaceVertices[local]] = static_cast<int>(c);
                }
            }
            base += mesh.vertexCount();
        }
        // A triangle that is a line or a point goes to a point: it has no texels to show.
        const ChartVertex& anywhere =
            mCorners[surface.sources[charts[0].mesh.triangles[0]].mesh]
                    [3 * surface.sources[charts[0].mesh.triangles[0]].triangle];
        for (const atlas::SourceTriangle& source : surface.dropped) {
            ChartVertex place = anywhere;
            for (int k = 0; k < 3; ++k) {
                const int v =
                    surface
                        .welded[source.mesh][meshes[source.mesh]->indices[3 * source.triangle + k]];
                if (atVertex[v].number >= 0) {
                    place = atVertex[v];
                    mCharts[source.mesh][source.triangle] =
                        static_cast<std::uint32_t>(chartAtVertex[v]);
                    break;
                }
            }
            for (int k = 0; k < 3; ++k) {
                mCorners[source.mesh][3 * source.triangle + k] = place;
            }
        }
    }

    [[nodiscard]] AtlasMesh write(const Mesh& mesh, std::size_t m) {
        AtlasMesh result;
        result.chartOfTriangle = std::move(mCharts[m]);
        result.indices.reserve(mesh.indices.size());
        // New vertices of one input vertex form a list.
        std::vector<int> first(mesh.positions.size(), -1);
        std::vector<int> following;
        std::vector<int> chartVertex;
        for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
            const std::uint32_t source = mesh.indices[i];
            const ChartVertex& corner = mCorners[m][i];
            int found = first[source];
            while (found >= 0 && chartVertex[found] != corner.number) {
                found = following[found];
            }
            if (found < 0) {
                found = static_cast<int>(chartVertex.size());
                chartVertex.push_back(corner.number);
                following.push_back(first[source]);
                first[source] = found;
                result.sourceVertex.push_back(source);
                result.uvs.push_back(corner.uv);
            }
            result.indices.push_back(static_cast<std::uint32_t>(found));
        }
        return result;
    }

private:
    std::vector<std::vector<ChartVertex>> mCorners; ///< mesh, 3 triangle + corner
    std::vector<std::vector<std::uint32_t>> mCharts;
};

AtlasReport makeReport(const atlas::Surface& surface, const std::vector<atlas::Chart>& charts,
                       const atlas::Packing& packing) {
    AtlasReport report;
    report.charts = static_cast<int>(charts.size());
    report.gutterTexels = packing.gutterTexels;
    struct Ratio {
        double area, mapArea;
    };
    std::vector<Ratio> ratios;
    for (std::size_t c = 0; c < charts.size(); ++c) {
        const atlas::ChartMesh& mesh = charts[c].mesh;
        const double scale = packing.placements[c].linear.determinant();
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
            const std::array<int, 3>& v = mesh.corners[t];
            Eigen::Matrix2d sides;
            sides << charts[c].uv[v[1]] - charts[c].uv[v[0]],
                charts[c].uv[v[2]] - charts[c].uv[v[0]];
            ratios.push_back({surface.areas[mesh.triangles[t]], 0.5 * scale * sides.determinant()});
            report.coverage += ratios.back().mapArea;
        }
    }
    const double mean = report.coverage / surface.totalArea;
    std::vector<std::pair<double, double>> distortions; // value, area
    double total = 0.0;
    for (const Ratio& ratio : ratios) {
        if (ratio.area > 0.0) {
            const double s = std::max(ratio.mapArea / (ratio.area * mean), 1e-12);
            distortions.emplace_back(std::max(s, 1.0 / s), ratio.area);
            report.areaDistortionMean += distortions.back().first * ratio.area;
            total += ratio.area;
        }
    }
    report.areaDistortionMean /= total;
    std::sort(distortions.begin(), distortions.end());
    double below = 0.0;
    for (const auto& [value, area] : distortions) {
        below += area;
        report.areaDistortionMax = value;
        if (below >= 0.999 * total) {
            break;
        }
    }
    return report;
}

template<typename T>
void gather(const std::vector<std::uint32_t>& source, std::vector<T>& values) {
    if (values.empty()) {
        return;
    }
    std::vector<T> gathered;
    gathered.reserve(source.size());
    for (const std::uint32_t v : source) {
        gathered.push_back(values[v]);
    }
    values = std::move(gathered);
}

} // namespace

Atlas generateAtlas(std::span<const Mesh* const> meshes, const AtlasSettings& settings) {
    Atlas result;
    if (meshes.empty()) {
        return result;
    }
    const atlas::Surface surface = atlas::buildSurface(meshes);
    const std::vector<atlas::Chart> charts = atlas::partition(surface);
    const atlas::Packing packing = atlas::pack(outlinesOf(charts), std::max(settings.resolution, 1),
                                               std::max(settings.gutterTexels, 0));
    result.report = makeReport(surface, charts, packing);
    AtlasWriter writer(meshes, surface, charts, packing);
    for (std::size_t m = 0; m < meshes.size(); ++m) {
        result.meshes.push_back(writer.write(*meshes[m], m));
    }
    return result;
}

void applyAtlas(const AtlasMesh& atlas, Mesh& mesh) {
    CELADON_ASSERT(atlas.indices.size() == mesh.indices.size());
    gather(atlas.sourceVertex, mesh.positions);
    gather(atlas.sourceVertex, mesh.normals);
    gather(atlas.sourceVertex, mesh.uvs1);
    gather(atlas.sourceVertex, mesh.colors);
    gather(atlas.sourceVertex, mesh.bindingVertices);
    mesh.uvs = atlas.uvs;
    mesh.indices = atlas.indices;
}

} // namespace celadon
