#include "renderer/scene/atlas_smooth_borders.h"

#include <algorithm>
#include <array>
#include <map>

namespace celadon::atlas {
namespace {

constexpr int kRounds = 3;
constexpr int kDiffusionSteps = 8;

/// The strongest few labels at a node; where more meet, the weakest is lost, which nobody sees.
struct Mixture {
    std::array<int, 4> label = {-1, -1, -1, -1};
    std::array<double, 4> weight = {};

    void add(int which, double amount) {
        int weakest = 0;
        for (int i = 0; i < 4; ++i) {
            if (label[i] == which) {
                weight[i] += amount;
                return;
            }
            if (weight[i] < weight[weakest]) {
                weakest = i;
            }
        }
        if (amount > weight[weakest]) {
            label[weakest] = which;
            weight[weakest] = amount;
        }
    }
};

/// Nodes that diffusion can reach from a border.
std::vector<int> borderBand(const DualGraph& graph, const std::vector<int>& labels) {
    std::vector<int> band;
    std::vector<bool> inside(graph.size(), false);
    for (int t = 0; t < graph.size(); ++t) {
        for (int k = 0; k < 3; ++k) {
            const int n = graph.neighbors[3 * t + k];
            if (n >= 0 && labels[n] != labels[t] && !inside[t]) {
                inside[t] = true;
                band.push_back(t);
            }
        }
    }
    std::size_t begin = 0;
    for (int ring = 0; ring < kDiffusionSteps; ++ring) {
        const std::size_t end = band.size();
        for (; begin < end; ++begin) {
            for (int k = 0; k < 3; ++k) {
                const int n = graph.neighbors[3 * band[begin] + k];
                if (n >= 0 && !inside[n]) {
                    inside[n] = true;
                    band.push_back(n);
                }
            }
        }
    }
    return band;
}

void diffuseRound(const DualGraph& graph, std::vector<int>& labels) {
    const std::vector<int> band = borderBand(graph, labels);
    std::vector<int> place(graph.size(), -1);
    for (std::size_t i = 0; i < band.size(); ++i) {
        place[band[i]] = static_cast<int>(i);
    }
    std::vector<Mixture> now(band.size());
    for (std::size_t i = 0; i < band.size(); ++i) {
        now[i].add(labels[band[i]], 1.0);
    }
    std::vector<Mixture> next(band.size());
    for (int step = 0; step < kDiffusionSteps; ++step) {
        for (std::size_t i = 0; i < band.size(); ++i) {
            const int t = band[i];
            Mixture mixture;
            const auto blend = [&](const Mixture& other, double weight) {
                for (int j = 0; j < 4; ++j) {
                    if (other.weight[j] > 0.0) {
                        mixture.add(other.label[j], weight * other.weight[j]);
                    }
                }
            };
            const double perimeter = graph.edgeLengths[3 * t] + graph.edgeLengths[3 * t + 1] +
                                     graph.edgeLengths[3 * t + 2];
            double kept = 0.25;
            for (int k = 0; k < 3; ++k) {
                const double share = 0.75 * graph.edgeLengths[3 * t + k] / perimeter;
                const int n = graph.neighbors[3 * t + k];
                const double conduction =
                    n < 0 ? 0.0 : std::max(0.02, graph.faceNormals[t].dot(graph.faceNormals[n]));
                kept += share * (1.0 - conduction);
                if (n < 0) {
                    continue;
                }
                if (place[n] >= 0) {
                    blend(now[place[n]], share * conduction);
                } else {
                    mixture.add(labels[n], share * conduction);
                }
            }
            blend(now[i], kept);
            next[i] = mixture;
        }
        now.swap(next);
    }
    for (std::size_t i = 0; i < band.size(); ++i) {
        int& label = labels[band[i]];
        double strongest = -1.0;
        for (int j = 0; j < 4; ++j) {
            if (now[i].label[j] == label) {
                strongest = now[i].weight[j];
            }
        }
        for (int j = 0; j < 4; ++j) {
            if (now[i].weight[j] > strongest + 1e-12) {
                strongest = now[i].weight[j];
                label = now[i].label[j];
            }
        }
    }
}

/// Of each label only the largest connected part keeps it; the others go to the neighbor with which
/// they share most border.
void absorbIslands(const DualGraph& graph, std::vector<int>& labels) {
    const std::vector<int> parts = connectedParts(graph, labels);
    const int count = parts.empty() ? 0 : 1 + *std::max_element(parts.begin(), parts.end());
    std::vector<double> area(count, 0.0);
    std::vector<int> labelOf(count, -1);
    for (int t = 0; t < graph.size(); ++t) {
        area[parts[t]] += graph.areas[t];
        labelOf[parts[t]] = labels[t];
    }
    std::map<int, int> largest; // label -> part
    for (int part = 0; part < count; ++part) {
        const auto [place, isNew] = largest.try_emplace(labelOf[part], part);
        if (!isNew && area[part] > area[place->second]) {
            place->second = part;
        }
    }
    if (static_cast<int>(largest.size()) == count) {
        return;
    }
    std::map<std::pair<int, int>, double> borders; // island, neighboring label -> length
    for (int t = 0; t < graph.size(); ++t) {
        for (int k = 0; k < 3; ++k) {
            const int n = graph.neighbors[3 * t + k];
            if (n >= 0 && parts[n] != parts[t] && largest[labels[t]] != parts[t]) {
                borders[{parts[t], labels[n]}] += graph.edgeLengths[3 * t + k];
            }
        }
    }
    std::vector<int> target = labelOf;
    std::vector<double> longest(count, 0.0);
    for (const auto& [border, length] : borders) {
        if (length > longest[border.first]) {
            longest[border.first] = length;
            target[border.first] = border.second;
        }
    }
    for (int t = 0; t < graph.size(); ++t) {
        labels[t] = target[parts[t]];
    }
}

/// Hands over each triangle whose change of side makes the border shorter: teeth, which the
/// threshold leaves where a straight line crosses triangles. Every change shortens, so this ends.
void trimTeeth(const DualGraph& graph, std::vector<int>& labels) {
    std::vector<int> queue;
    for (int t = graph.size() - 1; t >= 0; --t) {
        queue.push_back(t);
    }
    while (!queue.empty()) {
        const int t = queue.back();
        queue.pop_back();
        double own = 0.0;   // edges towards the same label
        double other = 0.0; // edges towards the one label that touches most
        int label = -1;
        for (int k = 0; k < 3; ++k) {
            const int n = graph.neighbors[3 * t + k];
            if (n < 0) {
                continue;
            }
            if (labels[n] == labels[t]) {
                own += graph.edgeLengths[3 * t + k];
                continue;
            }
            double towards = 0.0;
            for (int j = 0; j < 3; ++j) {
                const int m = graph.neighbors[3 * t + j];
                towards += m >= 0 && labels[m] == labels[n] ? graph.edgeLengths[3 * t + j] : 0.0;
            }
            if (towards > other) {
                other = towards;
                label = labels[n];
            }
        }
        if (other <= (1.0 + 1e-9) * own) {
            continue;
        }
        labels[t] = label;
        for (int k = 2; k >= 0; --k) {
            if (graph.neighbors[3 * t + k] >= 0) {
                queue.push_back(graph.neighbors[3 * t + k]);
            }
        }
    }
}

} // namespace

void smoothBorders(const DualGraph& graph, std::vector<int>& labels) {
    for (int round = 0; round < kRounds; ++round) {
        diffuseRound(graph, labels);
    }
    trimTeeth(graph, labels);
    absorbIslands(graph, labels);
}

} // namespace celadon::atlas
