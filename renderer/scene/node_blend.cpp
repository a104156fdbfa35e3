#include "renderer/scene/node_blend.h"

namespace celadon {

Mapped followNodes(const VertexNodes& vertex, const NodePose& pose) {
    const glm::dvec3 p(vertex.at);
    const auto carried = [&](std::uint32_t n) {
        return pose.nodes[n].to + pose.nodes[n].linear * (p - pose.binding->places[n]);
    };
    if (vertex.nodes[0] == kNoNode) {
        return {p};
    }
    if (vertex.nodes[1] == kNoNode) {
        return {carried(vertex.nodes[0]), pose.nodes[vertex.nodes[0]].linear};
    }
    const glm::dvec3 toLast = p - pose.binding->places[vertex.nodes[4]];
    const double D2 = glm::dot(toLast, toLast);
    double sum = 0.0;
    glm::dvec3 sumSlope(0.0);
    glm::dvec3 position(0.0);
    glm::dmat3 linear(0.0);
    glm::dmat3 swept(0.0); // of positions times the slopes of weights
    for (int k = 0; k < 4; ++k) {
        const std::uint32_t n = vertex.nodes[static_cast<std::size_t>(k)];
        const glm::dvec3 to = p - pose.binding->places[n];
        const double d2 = glm::dot(to, to);
        const double rest = 1.0 - d2 / D2;
        const double w = rest * rest;
        const glm::dvec3 slope = 4.0 * rest / D2 * (d2 / D2 * toLast - to);
        const glm::dvec3 x = carried(n);
        sum += w;
        sumSlope += slope;
        position += w * x;
        linear += w * pose.nodes[n].linear;
        swept += glm::outerProduct(x, slope);
    }
    constexpr double kNoWeight = 1e-9; // all as far as the fifth
    if (!(sum > kNoWeight)) {
        return {carried(vertex.nodes[0]), pose.nodes[vertex.nodes[0]].linear};
    }
    position /= sum;
    return {position, (linear + swept - glm::outerProduct(position, sumSlope)) / sum};
}

glm::dmat4 affineAt(const VertexNodes& vertex, const NodePose& pose) {
    const Mapped mapped = followNodes(vertex, pose);
    glm::dmat4 result(mapped.jacobian);
    result[3] = glm::dvec4(mapped.position - mapped.jacobian * glm::dvec3(vertex.at), 1.0);
    return result;
}

} // namespace celadon
