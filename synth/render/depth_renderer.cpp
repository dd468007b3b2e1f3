#include "synth/render/depth_renderer.h"

#include <array>

#include <GL/osmesa.h>

#include "core/error.h"

namespace vitruvia {
namespace {

constexpr int kDepthBits = 32;

// Looks up OSMesa's own functions by name: a program that also draws with other libraries may
// contain other functions of the same names, and the linker might choose those.
template <class Function>
Function* Find(const char* name) {
  auto* function = reinterpret_cast<Function*>(OSMesaGetProcAddress(name));
  if (function == nullptr) throw RunError(fmt::format("OSMesa: has no {}", name));
  return function;
}

struct Gl {
  decltype(glEnable)* Enable = Find<decltype(glEnable)>("glEnable");
  decltype(glDisable)* Disable = Find<decltype(glDisable)>("glDisable");
  decltype(glDepthFunc)* DepthFunc = Find<decltype(glDepthFunc)>("glDepthFunc");
  decltype(glColorMask)* ColorMask = Find<decltype(glColorMask)>("glColorMask");
  decltype(glClearDepth)* ClearDepth = Find<decltype(glClearDepth)>("glClearDepth");
  decltype(glClear)* Clear = Find<decltype(glClear)>("glClear");
  decltype(glEnableClientState)* EnableClientState =
      Find<decltype(glEnableClientState)>("glEnableClientState");
  decltype(glVertexPointer)* VertexPointer = Find<decltype(glVertexPointer)>("glVertexPointer");
  decltype(glDrawElements)* DrawElements = Find<decltype(glDrawElements)>("glDrawElements");
  decltype(glViewport)* Viewport = Find<decltype(glViewport)>("glViewport");
  decltype(glMatrixMode)* MatrixMode = Find<decltype(glMatrixMode)>("glMatrixMode");
  decltype(glLoadMatrixd)* LoadMatrixd = Find<decltype(glLoadMatrixd)>("glLoadMatrixd");
  decltype(glLoadIdentity)* LoadIdentity = Find<decltype(glLoadIdentity)>("glLoadIdentity");
  decltype(glPixelStorei)* PixelStorei = Find<decltype(glPixelStorei)>("glPixelStorei");
  decltype(glReadPixels)* ReadPixels = Find<decltype(glReadPixels)>("glReadPixels");
  decltype(glGetError)* GetError = Find<decltype(glGetError)>("glGetError");
};

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

// std::invalid_argument for input with which the driver would read beyond an array or draw
// undefined pixels.
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
  Gl gl;
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

void Draw(const Gl& gl, const std::vector<Vector3f>& vertices,
          const std::vector<Triangle>& triangles) {
  gl.Enable(GL_DEPTH_TEST);
  gl.DepthFunc(GL_LESS);
  gl.Disable(GL_CULL_FACE);
  gl.ColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  gl.ClearDepth(1.0);
  gl.Clear(GL_DEPTH_BUFFER_BIT);
  if (triangles.empty()) return;
  gl.EnableClientState(GL_VERTEX_ARRAY);
  gl.VertexPointer(3, GL_FLOAT, sizeof(Vector3f), vertices.data());
  gl.DrawElements(GL_TRIANGLES, static_cast<GLsizei>(3 * triangles.size()), GL_UNSIGNED_INT,
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
  const Gl& gl = c.gl;
  const int width = c.camera.width, height = c.camera.height;
  {
    const Current current(c.mesa, c.colour.data(), width, height);
    gl.Viewport(0, 0, width, height);
    gl.MatrixMode(GL_PROJECTION);
    gl.LoadMatrixd(ClipFromCamera(c.camera, c.near_m, c.far_m).data());
    gl.MatrixMode(GL_MODELVIEW);
    gl.LoadIdentity();
    Draw(gl, vertices_in_camera, triangles);
    gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
    gl.ReadPixels(0, 0, width, height, GL_DEPTH_COMPONENT, GL_FLOAT, c.window_depth.data());
    const GLenum error = gl.GetError();
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
