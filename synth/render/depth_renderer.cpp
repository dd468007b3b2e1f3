#include "synth/render/depth_renderer.h"

#include <array>

#include <GL/osmesa.h>

#include "core/error.h"

namespace vitruvia {
namespace {

constexpr int kDepthBits = 32;

// Column-major clip_from_camera. The image's pixel (u, v) has its centre at window coordinates
// (u + ½, v + ½). Row 0 is the window's lowest row: image rows are kept in memory order, and the
// picture is never turned over. Window depth runs from 0 at near to 1 at far.
std::array<double, 16> ClipFromCamera(const PinholeCamera& c, double near_m, double far_m) {
  std::array<double, 16> m{};
  m[0] = 2.0 * c.fx / c.width;
  m[5] = 2.0 * c.fy / c.height;
  m[8] = 2.0 * (c.cx + 0.5) / c.width - 1.0;
  m[9] = 2.0 * (c.cy + 0.5) / c.height - 1.0;
  m[10] = (far_m + near_m) / (far_m - near_m);
  m[11] = 1.0;
  m[14] = -2.0 * far_m * near_m / (far_m - near_m);
  return m;
}

// Misuse that would make the driver read beyond an array, or draw anything at all.
void RequireDrawable(const std::vector<Vector3f>& vertices,
                     const std::vector<Triangle>& triangles) {
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    Require(vertices[i].allFinite(), "DepthRenderer::Render: vertex {} is not finite", i);
  }
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (const std::int32_t i : triangles[t]) {
      Require(i >= 0 && static_cast<std::size_t>(i) < vertices.size(),
              "DepthRenderer::Render: triangle {} names vertex {} of {}", t, i, vertices.size());
    }
  }
}

}  // namespace

struct DepthRenderer::Context {
  PinholeCamera camera;
  double near_m, far_m;
  OSMesaContext mesa = nullptr;
  std::vector<std::uint8_t> colour;  // OSMesa wants somewhere to draw to; never looked at
  std::vector<float> window_depth;

  Context(const PinholeCamera& camera_in, double near_in, double far_in)
      : camera(camera_in), near_m(near_in), far_m(far_in) {
    const std::size_t pixels = static_cast<std::size_t>(camera.width) * camera.height;
    colour.resize(4 * pixels);
    window_depth.resize(pixels);
    mesa = OSMesaCreateContextExt(OSMESA_RGBA, kDepthBits, 0, 0, nullptr);
    if (mesa == nullptr) throw RunError("OSMesa: no rendering context could be made");
  }
  ~Context() { OSMesaDestroyContext(mesa); }
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
};

namespace {

// Makes a context current for as long as it lives. Nothing stays current afterwards: several
// renderers, and others who draw through OSMesa, each make theirs current when they draw.
class Current {
 public:
  Current(OSMesaContext mesa, void* colour, int width, int height) {
    if (OSMesaMakeCurrent(mesa, colour, GL_UNSIGNED_BYTE, width, height) != GL_TRUE) {
      throw RunError(fmt::format("OSMesa: cannot draw to an image of {}×{}", width, height));
    }
  }
  ~Current() { OSMesaMakeCurrent(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0); }
  Current(const Current&) = delete;
  Current& operator=(const Current&) = delete;
};

void Draw(const std::vector<Vector3f>& vertices, const std::vector<Triangle>& triangles) {
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glDisable(GL_CULL_FACE);
  glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  glClearDepth(1.0);
  glClear(GL_DEPTH_BUFFER_BIT);
  if (triangles.empty()) return;
  glEnableClientState(GL_VERTEX_ARRAY);
  glVertexPointer(3, GL_FLOAT, sizeof(Vector3f), vertices.data());
  glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(3 * triangles.size()), GL_UNSIGNED_INT,
                 triangles.data());
}

}  // namespace

DepthRenderer::DepthRenderer(const PinholeCamera& camera, double near_m, double far_m) {
  Require(camera.width >= 1 && camera.height >= 1, "DepthRenderer: image of {}×{} pixels",
          camera.width, camera.height);
  Require(near_m > 0.0 && far_m > near_m, "DepthRenderer: near {} m, far {} m", near_m, far_m);
  context_ = std::make_unique<Context>(camera, near_m, far_m);
}

DepthRenderer::~DepthRenderer() = default;

DepthImage DepthRenderer::Render(const std::vector<Vector3f>& vertices_in_camera,
                                 const std::vector<Triangle>& triangles) {
  RequireDrawable(vertices_in_camera, triangles);
  Context& c = *context_;
  const int width = c.camera.width, height = c.camera.height;
  {
    const Current current(c.mesa, c.colour.data(), width, height);
    glViewport(0, 0, width, height);
    glMatrixMode(GL_PROJECTION);
    glLoadMatrixd(ClipFromCamera(c.camera, c.near_m, c.far_m).data());
    glMatrixMode(GL_MODELVIEW);
    glLoadIdentity();
    Draw(vertices_in_camera, triangles);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, width, height, GL_DEPTH_COMPONENT, GL_FLOAT, c.window_depth.data());
    const GLenum error = glGetError();
    if (error != GL_NO_ERROR) {
      throw RunError(fmt::format("OSMesa: drawing failed with GL error {:#x}", error));
    }
  }
  DepthImage depth(width, height);
  for (std::size_t i = 0; i < c.window_depth.size(); ++i) {
    const double d = c.window_depth[i];
    // 1/z runs linearly from 1/near at d = 0 to 1/far at d = 1; the clear value is far away.
    if (d < 1.0) {
      depth.pixels()[i] =
          static_cast<float>(c.near_m * c.far_m / (c.far_m - d * (c.far_m - c.near_m)));
    }
  }
  return depth;
}

}  // namespace vitruvia
