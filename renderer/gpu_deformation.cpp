#include "renderer/gpu_deformation.h"

#include "renderer/gl/debug.h"
#include "subedit/errors.h"

#include <algorithm>
#include <array>

namespace celadon {

namespace {

constexpr int kBoundedEach = 32; ///< vertices of an invocation of `vertex_bounds.comp`

/// `include/deformer.glsl`
struct DeformerEntry {
    glm::vec4 kind;
    glm::vec4 lattice;
    glm::vec4 center;
    glm::vec4 amount;
    glm::vec4 bounds;
};

/// `vertex_bounds.comp`
struct BoundsEntry {
    std::uint32_t low[3] = {~0u, ~0u, ~0u};
    std::uint32_t high[3] = {0, 0, 0};
    std::uint32_t farthest = 0;
    std::uint32_t gone = 0;
};

/// `include/vertex_pose.glsl`
enum MeshFlags { kHasMap = 1, kHasMiters = 2, kIsHandled = 4 };
constexpr std::size_t kHandledFloats = 9;

/// Texture units of `deform.comp` and `handles.comp`.
constexpr GLuint kMatricesUnit = 0;
constexpr GLuint kDeformersUnit = 1, kNodesUnit = 1;
constexpr GLuint kVertexNodesUnit = 2;

/// `handles.comp`
struct NodeEntry {
    glm::vec4 place;
    glm::vec4 to;
    glm::vec4 linear[3];
};
static_assert(sizeof(VertexNodes) == 64);

/// Position and normal of each vertex, six floats.
std::vector<float> interleaved(const std::vector<glm::vec3>& positions,
                               const std::vector<glm::vec3>& normals) {
    std::vector<float> result;
    result.reserve(6 * positions.size());
    for (std::size_t i = 0; i < positions.size(); ++i) {
        const glm::vec3 normal = normals.empty() ? glm::vec3(0.0f) : normals[i];
        result.insert(result.end(), {positions[i].x, positions[i].y, positions[i].z, normal.x,
                                     normal.y, normal.z});
    }
    return result;
}

/// Values of which there are more or fewer from pose to pose; the buffer grows where it must.
/// @return whether it is another one
template<typename T>
bool send(const char* label, const std::vector<T>& values, gl::Buffer& buffer) {
    const std::size_t bytes = std::max<std::size_t>(values.size(), 4) * sizeof(T);
    const bool grows = buffer.sizeBytes() < bytes;
    if (grows) {
        buffer = gl::Buffer(label, 2 * bytes, gl::BufferUse::Update);
    }
    if (!values.empty()) {
        buffer.write(values);
    }
    return grows;
}

BoundingSphere toSphere(const glm::vec4& v) {
    return {glm::dvec3(v), static_cast<double>(v.w)};
}

/// @param firstOffset of a lattice, among those of all lattices
DeformerEntry entryOf(const Deformer& deformer, const RestBox& box, std::size_t firstOffset) {
    constexpr double kPi = 3.14159265358979323846;
    constexpr double kEverywhere = 1e30;
    const int axis = deformer.axis;
    DeformerEntry entry{};
    entry.kind = glm::vec4(static_cast<float>(deformer.kind), axis, 0.0f, 0.0f);
    if (deformer.kind == Deformer::Kind::Lattice) {
        entry.lattice = glm::vec4(deformer.lattice.size, firstOffset);
        entry.center = glm::vec4(1.0 / (box.high - box.low), 0.0);
        entry.amount = glm::vec4(box.low, 0.0);
        return entry;
    }
    const glm::dvec2 range = deformer.range.value_or(glm::dvec2(0.0, 1.0));
    const double extent = box.high[axis] - box.low[axis];
    const double low = box.low[axis] + range.x * extent;
    const double length = (range.y - range.x) * extent;
    double rate = deformer.amount;
    double wave = 0.0;
    switch (deformer.kind) {
    case Deformer::Kind::Twist:
    case Deformer::Kind::Bend:
        rate *= kPi / 180.0 / length;
        break;
    case Deformer::Kind::Taper:
        rate = (rate - 1.0) / length;
        break;
    case Deformer::Kind::Wave:
        wave = 2.0 * kPi / deformer.wavelengthMm;
        break;
    case Deformer::Kind::Inflate:
    case Deformer::Kind::Lattice:
    case Deformer::Kind::Handles:
        break;
    }
    entry.center = glm::vec4(0.5 * (box.low + box.high), 0.0);
    entry.amount = glm::vec4(rate, wave, low, 0.0);
    constexpr double kEndOfRange = 1e-5; // of its length, as in deformer.cpp
    entry.bounds = deformer.range ? glm::vec4(0.0, length, kEndOfRange * length, 0.0)
                                  : glm::vec4(-kEverywhere, kEverywhere, 0.0, 0.0);
    return entry;
}

} // namespace

GpuDeformation::GpuDeformation(const gl::ShaderLibrary& shaders, const World& rest,
                               const GpuWorld& target)
    : mRest(rest),
      mTarget(target),
      mMorph("morph", shaders, {"morph.comp"}),
      mHandles("handles", shaders, {"handles.comp"}),
      mDeform("deform", shaders, {"deform.comp"}),
      mDeformLattices("deform, lattices", shaders, {"deform.comp"}, {{"LATTICE", "1"}}),
      mFlatNormals("flat normals", shaders, {"flat_normals.comp"}),
      mFlip("flip triangles", shaders, {"flip_triangles.comp"}),
      mBoundsOf("vertex bounds", shaders, {"vertex_bounds.comp"}),
      mNothing("deformation: nothing", 64),
      mBounds("deformation: bounds", 2 * sizeof(BoundsEntry), gl::BufferUse::Update) {
    for (const WorldMesh& mesh : rest.meshes) {
        addMesh(mesh);
    }
}

void GpuDeformation::addMesh(const WorldMesh& source) {
    const Mesh& mesh = source.mesh;
    MovedMesh result;
    result.vertices = static_cast<int>(mesh.positions.size());
    result.triangles = static_cast<int>(mesh.triangleCount());
    const auto named = [&](const char* what) { return std::string(what) + " of " + mesh.name; };
    std::size_t matrices = 1;
    if (const MeshBinding* const binding = mesh.binding.get()) {
        result.isBound = true;
        result.isFlat = binding->normals.empty();
        result.bound =
            gl::Buffer::of(named("binding"), interleaved(binding->positions, binding->normals));
        result.map = gl::Buffer::of(named("binding vertices"), mesh.bindingVertices);
        result.influenceCount = binding->influences;
        if (binding->skin >= 0) {
            result.influences = gl::Buffer::of(named("influences"), binding->joints);
            matrices += mRest.rig->skins[static_cast<std::size_t>(binding->skin)].joints.size();
        }
        for (const MorphTarget& shape : binding->targets) {
            Target target;
            target.count = static_cast<int>(shape.vertices.size());
            if (target.count > 0) {
                target.vertices = gl::Buffer::of(named("morph vertices"), shape.vertices);
                target.changes = gl::Buffer::of(named("morph target"),
                                                interleaved(shape.positions, shape.normals));
            }
            result.targets.push_back(std::move(target));
        }
        if (!result.targets.empty()) {
            result.morphed = gl::Buffer(named("morphed"), result.bound.sizeBytes());
        }
    } else {
        result.bound =
            gl::Buffer::of(named("rest pose"), interleaved(mesh.positions, mesh.normals));
    }
    result.matrices =
        gl::Buffer::of(named("matrices"), std::vector<glm::mat4>(matrices, glm::mat4(1.0f)),
                       gl::BufferUse::Update);
    result.matrixTexels = gl::BufferTexture(named("matrices"), GL_RGBA32F, result.matrices);
    mMeshes.push_back(std::move(result));
}

const gl::Buffer& GpuDeformation::morph(MovedMesh& mesh, const std::vector<double>& weights) {
    if (mesh.targets.empty()) {
        return mesh.bound;
    }
    glCopyNamedBufferSubData(mesh.bound.id(), mesh.morphed.id(), 0, 0,
                             static_cast<GLsizeiptr>(mesh.bound.sizeBytes()));
    mMorph.use();
    mesh.morphed.bindStorage(0);
    for (std::size_t t = 0; t < std::min(mesh.targets.size(), weights.size()); ++t) {
        const Target& target = mesh.targets[t];
        if (target.count == 0 || weights[t] == 0.0) {
            continue;
        }
        mMorph.set(0, target.count);
        mMorph.set(1, static_cast<float>(weights[t]));
        target.vertices.bindStorage(1);
        target.changes.bindStorage(2);
        mMorph.dispatchList(target.count);
        glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    }
    return mesh.morphed;
}

void GpuDeformation::sendDeformers(const Pose& pose) {
    std::vector<DeformerEntry> entries;
    std::vector<glm::vec4> offsets;
    for (const Deformer& deformer : pose.deformers) {
        entries.push_back(entryOf(deformer, pose.box, offsets.size()));
        for (const glm::dvec3& offset : deformer.lattice.offsets) {
            offsets.emplace_back(offset, 0.0);
        }
    }
    if (send("deformers", entries, mDeformers)) {
        mDeformerTexels = gl::BufferTexture("deformers", GL_RGBA32F, mDeformers);
    }
    send("lattice offsets", offsets, mLatticeOffsets);
}

void GpuDeformation::bindVertices(const MovedMesh& mesh, const gl::Buffer& source,
                                  const gl::BufferTexture& matrices) const {
    source.bindStorage(0);
    orNothing(mesh.map).bindStorage(1);
    orNothing(mesh.influences).bindStorage(2);
    matrices.bind(kMatricesUnit);
}

const gl::Buffer& GpuDeformation::orNothing(const gl::Buffer& buffer) const {
    return buffer ? buffer : mNothing;
}

void GpuDeformation::sendNodes(const NodePose& pose) {
    std::vector<NodeEntry> entries;
    entries.reserve(pose.nodes.size());
    for (std::size_t n = 0; n < pose.nodes.size(); ++n) {
        const MovedNode& node = pose.nodes[n];
        entries.push_back({glm::vec4(pose.binding->places[n], 0.0),
                           glm::vec4(node.to, 0.0),
                           {glm::vec4(node.linear[0], 0.0), glm::vec4(node.linear[1], 0.0),
                            glm::vec4(node.linear[2], 0.0)}});
    }
    if (send("nodes", entries, mNodes)) {
        mNodeTexels = gl::BufferTexture("nodes", GL_RGBA32F, mNodes);
    }
    if (mNodeBinding == pose.binding) {
        return;
    }
    mNodeBinding = pose.binding;
    for (std::size_t m = 0; m < mMeshes.size(); ++m) {
        MovedMesh& mesh = mMeshes[m];
        mesh.vertexNodes = gl::Buffer::of("vertices of nodes", pose.binding->vertices[m]);
        mesh.vertexNodeTexels = gl::BufferTexture("vertices of nodes", GL_R32UI, mesh.vertexNodes);
        std::vector<glm::mat4> matrices(pose.binding->restPoses[m].matrices.begin(),
                                        pose.binding->restPoses[m].matrices.end());
        matrices.resize(std::max<std::size_t>(matrices.size(), 1), glm::mat4(1.0f));
        mesh.restMatrices = gl::Buffer::of("rest matrices", matrices);
        mesh.restMatrixTexels = gl::BufferTexture("rest matrices", GL_RGBA32F, mesh.restMatrices);
        mesh.handled = gl::Buffer("handled", static_cast<std::size_t>(mesh.vertices) *
                                                 kHandledFloats * sizeof(float));
    }
}

const gl::Buffer& GpuDeformation::moveByNodes(MovedMesh& mesh, const gl::Buffer& bound, int flags) {
    mHandles.use();
    mHandles.set(0, glm::ivec4(mesh.vertices, mesh.influenceCount, 0, flags));
    bindVertices(mesh, bound, mesh.restMatrixTexels);
    mesh.handled.bindStorage(4);
    mNodeTexels.bind(kNodesUnit);
    orNothing(mesh.miters).bindStorage(6);
    mesh.vertexNodeTexels.bind(kVertexNodesUnit);
    mHandles.dispatchList(mesh.vertices);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    return mesh.handled;
}

void GpuDeformation::move(std::size_t index, const Pose& pose) {
    MovedMesh& mesh = mMeshes[index];
    const bool moves = mesh.isBound || !pose.deformers.empty();
    if (!moves && !mesh.isMoved) {
        return;
    }
    mesh.isMoved = moves;
    const GpuWorld::Geometry geometry = mTarget.geometry(index);
    const MeshPose& meshPose = pose.meshes[index];
    if (mesh.isBound) {
        const std::vector<glm::mat4> matrices(meshPose.matrices.begin(), meshPose.matrices.end());
        mesh.matrices.write(matrices);
    }
    int flags = mesh.isBound ? kHasMap : 0;
    if (needsMiters(pose)) {
        if (!mesh.miters) {
            mesh.miters = gl::Buffer::of("miters", miterDirections(mRest.meshes[index].mesh));
        }
        flags |= kHasMiters;
    }
    const gl::Buffer* source = &morph(mesh, meshPose.weights);
    if (pose.nodes) {
        source = &moveByNodes(mesh, *source, flags);
        flags |= kIsHandled;
    }
    const bool hasLattice =
        std::any_of(pose.deformers.begin(), pose.deformers.end(), [](const Deformer& deformer) {
            return deformer.kind == Deformer::Kind::Lattice;
        });
    const gl::Program& deform = hasLattice ? mDeformLattices : mDeform;
    deform.use();
    deform.set(0, glm::ivec4(mesh.vertices, mesh.influenceCount,
                             static_cast<int>(pose.deformers.size()), flags));
    deform.set(1, GpuWorld::kVertexFloats);
    bindVertices(mesh, *source, mesh.matrixTexels);
    geometry.bindVertices(4);
    mDeformerTexels.bind(kDeformersUnit);
    orNothing(mesh.miters).bindStorage(6);
    mLatticeOffsets.bindStorage(7);
    deform.dispatchList(mesh.vertices);
    if (mesh.isMirrored != pose.mirrored[index]) {
        mesh.isMirrored = pose.mirrored[index];
        mFlip.use();
        mFlip.set(0, mesh.triangles);
        geometry.bindIndices(0);
        mFlip.dispatchList(mesh.triangles);
    }
    if (mesh.isFlat) {
        glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
        mFlatNormals.use();
        mFlatNormals.set(0, mesh.triangles);
        mFlatNormals.set(1, GpuWorld::kVertexFloats);
        geometry.bindVertices(0);
        geometry.bindIndices(1);
        mFlatNormals.dispatchList(mesh.triangles);
    }
}

void GpuDeformation::measure() {
    mBounds.write(std::array<BoundsEntry, 2>{});
    mBoundsOf.use();
    mBoundsOf.set(1, GpuWorld::kVertexFloats);
    mBounds.bindStorage(1);
    mTarget.bounds().bindStorage(2);
    for (int task = 0; task < 2; ++task) {
        for (std::size_t m = 0; m < mMeshes.size(); ++m) {
            const GpuWorld::Geometry geometry = mTarget.geometry(m);
            mBoundsOf.set(0, mMeshes[m].vertices);
            mBoundsOf.set(2, glm::ivec2(task, geometry.scatters ? 1 : 0));
            geometry.bindVertices(0);
            mBoundsOf.dispatchList(mMeshes[m].vertices, kBoundedEach);
        }
        glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    }
    mBoundsOf.set(2, glm::ivec2(2, 0));
    mBoundsOf.dispatchList(1);
    glMemoryBarrier(GL_UNIFORM_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
}

void GpuDeformation::apply(const Pose& pose) {
    const gl::DebugGroup group("deformation");
    sendDeformers(pose);
    if (pose.nodes) {
        sendNodes(*pose.nodes);
    }
    for (std::size_t m = 0; m < mMeshes.size(); ++m) {
        move(m, pose);
    }
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT |
                    GL_ELEMENT_ARRAY_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
    measure();
}

GpuDeformation::Bounds GpuDeformation::bounds(const Pose& pose) const {
    if (mBounds.read<BoundsEntry>().front().gone > 0) {
        refuseExplosion(mRest, pose);
        throw InputError("the deformation", "takes the surface beyond what the GPU can count",
                         "give it smaller amounts");
    }
    const blocks::BoundsBlock spheres = mTarget.readBounds();
    return {toSphere(spheres.scattering), toSphere(spheres.scene)};
}

} // namespace celadon
