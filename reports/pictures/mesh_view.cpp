#include "reports/pictures/mesh_view.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace vitruvia {
namespace {

constexpr int kSamples = 2;  // of a pixel, in each direction
constexpr float kNear_m = 0.1f;

// A skin without gloss: shape shows, and colours that mean a number stay readable.
constexpr float kAmbient = 0.45f, kDiffuse = 0.75f;

struct Light {
  Vector3f towards;  // unit, camera frame
  float intensity;
};

// From over the camera's left shoulder, with a weaker one from the right; both very far.
const std::array<Light, 2> kLights = {{{Vector3f(-0.6f, -0.8f, -1.0f).normalized(), 0.75f},
                                       {Vector3f(1.2f, 0.1f, -0.8f).normalized(), 0.3f}}};

// The side that looks to the camera is lit.
float Brightness(const Vector3f& point, const Vector3f& normal) {
  const float side = normal.dot(point) > 0.0f ? -1.0f : 1.0f;
  float brightness = kAmbient;
  for (const Light& light : kLights) {
    brightness += kDiffuse * light.intensity * std::max(0.0f, side * normal.dot(light.towards));
  }
  return brightness;
}

}  // namespace

MeshView::MeshView(int width, int height)
    : width_(kSamples * width),
      height_(kSamples * height),
      inverse_z_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_)),
      colors_(inverse_z_.size()) {}

ColorImage MeshView::Draw(const PinholeCamera& camera, const PictureWindow& part,
                          const std::vector<ShadedMesh>& meshes) {
  std::ranges::fill(inverse_z_, 0.0f);
  for (const ShadedMesh& mesh : meshes) {
    PlaceCorners(camera, part, mesh);
    for (const auto& [a, b, c] : *mesh.triangles)
      DrawTriangle(corners_[a], corners_[b], corners_[c]);
  }
  return Averaged();
}

void MeshView::PlaceCorners(const PinholeCamera& camera, const PictureWindow& part,
                            const ShadedMesh& mesh) {
  const std::vector<Vector3f>& vertices = *mesh.vertices;
  Require(mesh.colors.size() == 1 || mesh.colors.size() == vertices.size(),
          "expected 1 or {} colours, got {}", vertices.size(), mesh.colors.size());
  ComputeVertexNormals(vertices, *mesh.triangles, normals_);
  // The camera counts from the first pixel's centre, and so do samples.
  constexpr double kHalf = 0.5;
  const double u_scale = width_ / part.width, v_scale = height_ / part.height;
  corners_.resize(vertices.size());
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Vector3f& point = vertices[i];
    Corner& corner = corners_[i];
    corner.inverse_z = point.z() > kNear_m ? 1.0f / point.z() : 0.0f;
    if (corner.inverse_z == 0.0f) continue;
    const Eigen::Vector2d pixel = camera.Project<double>(point.cast<double>());
    corner.u = static_cast<float>((pixel.x() + kHalf - part.left) * u_scale - kHalf);
    corner.v = static_cast<float>((pixel.y() + kHalf - part.top) * v_scale - kHalf);
    const float brightness = Brightness(point, normals_[i]);
    const Color& color = mesh.colors[mesh.colors.size() == 1 ? 0 : i];
    for (std::size_t k = 0; k < 3; ++k)
      corner.color[k] = std::min(255.0f, brightness * static_cast<float>(color[k]));
  }
}

void MeshView::DrawTriangle(const Corner& a, const Corner& b, const Corner& c) {
  constexpr float kToNearest = 0.5f;  // added before a cast to an integer, which truncates
  if (std::min({a.inverse_z, b.inverse_z, c.inverse_z}) == 0.0f) return;
  const float area = (b.u - a.u) * (c.v - a.v) - (b.v - a.v) * (c.u - a.u);
  if (area == 0.0f) return;
  // Clipped before they are rounded: far outside the picture the numbers do not fit an int.
  const auto low = [](float least, int end) {
    return static_cast<int>(std::ceil(std::clamp(least, 0.0f, static_cast<float>(end))));
  };
  const auto high = [](float most, int end) {
    return static_cast<int>(std::floor(std::clamp(most, -1.0f, static_cast<float>(end - 1))));
  };
  const int left = low(std::min({a.u, b.u, c.u}), width_);
  const int right = high(std::max({a.u, b.u, c.u}), width_);
  const int top = low(std::min({a.v, b.v, c.v}), height_);
  const int bottom = high(std::max({a.v, b.v, c.v}), height_);
  // Shares of b and c are linear in the picture, and so is 1/z.
  const float b_du = (c.v - a.v) / area, b_dv = -(c.u - a.u) / area;
  const float c_du = -(b.v - a.v) / area, c_dv = (b.u - a.u) / area;
  for (int v = top; v <= bottom; ++v) {
    const float dv = static_cast<float>(v) - a.v;
    for (int u = left; u <= right; ++u) {
      const float du = static_cast<float>(u) - a.u;
      const float share_b = du * b_du + dv * b_dv, share_c = du * c_du + dv * c_dv;
      const float share_a = 1.0f - share_b - share_c;
      if (std::min({share_a, share_b, share_c}) < 0.0f) continue;
      const float inverse_z = share_a * a.inverse_z + share_b * b.inverse_z + share_c * c.inverse_z;
      const std::size_t sample = static_cast<std::size_t>(v) * static_cast<std::size_t>(width_) +
                                 static_cast<std::size_t>(u);
      if (inverse_z <= inverse_z_[sample]) continue;
      inverse_z_[sample] = inverse_z;
      for (std::size_t k = 0; k < 3; ++k) {
        colors_[sample][k] = static_cast<std::uint8_t>(share_a * a.color[k] + share_b * b.color[k] +
                                                       share_c * c.color[k] + kToNearest);
      }
    }
  }
}

// A pixel's colour is the mean of what covers it; its opacity is the share that is covered.
ColorImage MeshView::Averaged() const {
  ColorImage image(width_ / kSamples, height_ / kSamples);
  for (int v = 0; v < image.height(); ++v) {
    for (int u = 0; u < image.width(); ++u) {
      std::array<int, 3> sum{};
      int covered = 0;
      for (int k = 0; k < kSamples * kSamples; ++k) {
        const int row = kSamples * v + k / kSamples, column = kSamples * u + k % kSamples;
        const std::size_t sample =
            static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) +
            static_cast<std::size_t>(column);
        if (inverse_z_[sample] == 0.0f) continue;
        ++covered;
        for (std::size_t c = 0; c < 3; ++c) sum[c] += colors_[sample][c];
      }
      ColorPixel& pixel = image(u, v);
      pixel = {0, 0, 0, 0};
      if (covered == 0) continue;
      for (std::size_t c = 0; c < 3; ++c) pixel[c] = static_cast<std::uint8_t>(sum[c] / covered);
      pixel[3] = static_cast<std::uint8_t>(255 * covered / (kSamples * kSamples));
    }
  }
  return image;
}

}  // namespace vitruvia
