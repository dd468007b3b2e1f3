#include "reports/export/gltf_export.h"

#include <cstring>
#include <sstream>
#include <tiny_gltf.h>
#include <utility>

#include "core/error.h"
#include "core/files.h"
#include "geometry/mesh.h"
#include "reports/export/exported_run.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

struct AnimatedMesh {
  std::string name;
  std::vector<Triangle> triangles;
  std::vector<std::vector<Vector3f>> frames;  // camera frame, metres
  std::vector<double> color;                  // red, green, blue, opacity
};

// Puts arrays of numbers into the model's only buffer.
class Arrays {
 public:
  explicit Arrays(tinygltf::Model& model) : model_(model) { model_.buffers.emplace_back(); }

  int Indices(const std::vector<Triangle>& triangles) {
    std::vector<std::uint32_t> indices;
    for (const Triangle& t : triangles) indices.insert(indices.end(), t.begin(), t.end());
    return Add(indices, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, TINYGLTF_TYPE_SCALAR, indices.size(),
               TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
  }

  int Positions(const std::vector<Vector3f>& points) {
    std::vector<float> values;
    for (const Vector3f& p : points) values.insert(values.end(), {p.x(), p.y(), p.z()});
    const int accessor = Add(values, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3,
                             points.size(), TINYGLTF_TARGET_ARRAY_BUFFER);
    const Eigen::AlignedBox3f box = BoundingBox(points);
    for (int axis = 0; axis < 3; ++axis) {
      model_.accessors[accessor].minValues.push_back(box.min()[axis]);
      model_.accessors[accessor].maxValues.push_back(box.max()[axis]);
    }
    return accessor;
  }

  int Scalars(const std::vector<float>& values) {
    return Add(values, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_SCALAR, values.size(), 0);
  }

  int Times(const std::vector<float>& times_s) {
    const int accessor = Scalars(times_s);
    model_.accessors[accessor].minValues = {times_s.front()};
    model_.accessors[accessor].maxValues = {times_s.back()};
    return accessor;
  }

 private:
  template <class Number>
  int Add(const std::vector<Number>& values, int component, int type, std::size_t count,
          int target) {
    std::vector<unsigned char>& data = model_.buffers[0].data;
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = data.size();
    view.byteLength = values.size() * sizeof(Number);
    view.target = target;
    data.resize(view.byteOffset + view.byteLength);
    std::memcpy(data.data() + view.byteOffset, values.data(), view.byteLength);
    tinygltf::Accessor accessor;
    accessor.bufferView = static_cast<int>(model_.bufferViews.size());
    accessor.componentType = component;
    accessor.type = type;
    accessor.count = count;
    model_.bufferViews.push_back(std::move(view));
    model_.accessors.push_back(std::move(accessor));
    return static_cast<int>(model_.accessors.size()) - 1;
  }

  tinygltf::Model& model_;
};

std::vector<Vector3f> Less(std::vector<Vector3f> points, const std::vector<Vector3f>& base) {
  for (std::size_t i = 0; i < points.size(); ++i) points[i] -= base[i];
  return points;
}

int AddMaterial(const AnimatedMesh& mesh, tinygltf::Model& model) {
  tinygltf::Material material;
  material.name = mesh.name;
  material.pbrMetallicRoughness.baseColorFactor = mesh.color;
  material.pbrMetallicRoughness.metallicFactor = 0.0;
  material.pbrMetallicRoughness.roughnessFactor = 0.8;
  material.doubleSided = true;
  if (mesh.color[3] < 1.0) material.alphaMode = "BLEND";
  model.materials.push_back(std::move(material));
  return static_cast<int>(model.materials.size()) - 1;
}

// The first frame is the mesh; the others are morph targets.
int AddMesh(const AnimatedMesh& animated, Arrays& arrays, tinygltf::Model& model) {
  tinygltf::Primitive primitive;
  primitive.mode = TINYGLTF_MODE_TRIANGLES;
  primitive.material = AddMaterial(animated, model);
  primitive.indices = arrays.Indices(animated.triangles);
  primitive.attributes["POSITION"] = arrays.Positions(animated.frames.front());
  for (std::size_t i = 1; i < animated.frames.size(); ++i) {
    primitive.targets.push_back(
        {{"POSITION", arrays.Positions(Less(animated.frames[i], animated.frames.front()))}});
  }
  tinygltf::Mesh mesh;
  mesh.name = animated.name;
  mesh.weights.assign(primitive.targets.size(), 0.0);
  mesh.primitives.push_back(std::move(primitive));
  model.meshes.push_back(std::move(mesh));
  return static_cast<int>(model.meshes.size()) - 1;
}

int AddNode(const AnimatedMesh& mesh, int mesh_index, tinygltf::Model& model) {
  tinygltf::Node node;
  node.name = mesh.name;
  node.mesh = mesh_index;
  node.rotation = {1.0, 0.0, 0.0, 0.0};  // half a turn about x: the camera frame's y points down
  model.nodes.push_back(std::move(node));
  return static_cast<int>(model.nodes.size()) - 1;
}

// At the time of frame i only target i has weight 1; at that of the first frame all weights are 0.
int AddWeights(std::size_t frames, Arrays& arrays) {
  const std::size_t targets = frames - 1;
  std::vector<float> weights(frames * targets, 0.0f);
  for (std::size_t i = 1; i < frames; ++i) weights[i * targets + i - 1] = 1.0f;
  return arrays.Scalars(weights);
}

tinygltf::Model ModelOf(const std::vector<AnimatedMesh>& meshes,
                        const std::vector<float>& times_s) {
  tinygltf::Model model;
  model.asset.version = "2.0";
  model.asset.generator = "vitruvia";
  Arrays arrays(model);
  tinygltf::Scene scene;
  const bool moves = times_s.size() > 1;
  tinygltf::Animation animation;
  animation.name = "frames";
  if (moves) {
    tinygltf::AnimationSampler sampler;
    sampler.input = arrays.Times(times_s);
    sampler.output = AddWeights(times_s.size(), arrays);
    sampler.interpolation = "LINEAR";
    animation.samplers.push_back(std::move(sampler));
  }
  for (const AnimatedMesh& mesh : meshes) {
    const int node = AddNode(mesh, AddMesh(mesh, arrays, model), model);
    scene.nodes.push_back(node);
    if (!moves) continue;
    tinygltf::AnimationChannel channel;
    channel.sampler = 0;
    channel.target_node = node;
    channel.target_path = "weights";
    animation.channels.push_back(std::move(channel));
  }
  if (moves) model.animations.push_back(std::move(animation));
  model.scenes.push_back(std::move(scene));
  model.defaultScene = 0;
  return model;
}

std::vector<int> EvenlyChosen(std::vector<int> frames, std::size_t most) {
  if (frames.size() <= most) return frames;
  std::vector<int> chosen;
  for (std::size_t i = 0; i < most; ++i)
    chosen.push_back(frames[i * (frames.size() - 1) / (most - 1)]);
  return chosen;
}

}  // namespace

int ExportGltf(const fs::path& experiment_folder, const std::string& run_id,
               std::vector<int> frames, const fs::path& file) {
  const bool all = frames.empty();
  ExportedRun run = OpenForExport(experiment_folder, run_id, std::move(frames));
  if (all) run.frames = EvenlyChosen(std::move(run.frames), kMostGltfFrames);
  std::vector<AnimatedMesh> meshes = {
      {"estimate", run.estimate.rest_mesh().triangles, {}, {0.10, 0.37, 0.69, 1.0}}};
  if (run.sequence.info().surface) {
    meshes.push_back(
        {"truth", run.sequence.true_rest_mesh().triangles, {}, {0.80, 0.33, 0.05, 0.4}});
  }
  std::vector<float> times_s;
  for (const int frame : run.frames) {
    times_s.push_back(static_cast<float>((frame - run.frames.front()) / run.sequence.info().fps));
    meshes[0].frames.push_back(run.estimate.ReadVertices(frame));
    if (meshes.size() > 1) meshes[1].frames.push_back(run.sequence.ReadTrueVertices(frame));
  }
  tinygltf::Model model = ModelOf(meshes, times_s);
  std::ostringstream stream;
  if (!tinygltf::TinyGLTF().WriteGltfSceneToStream(&model, stream, false, true))
    throw RunError(fmt::format("{}: cannot be written as glTF", file.string()));
  WriteWholeFile(file, stream.str());
  return static_cast<int>(run.frames.size());
}

}  // namespace vitruvia
