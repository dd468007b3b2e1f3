// Lit meshes seen by a pinhole camera.
#pragma once

#include <vector>

#include "geometry/camera.h"
#include "geometry/mesh.h"
#include "reports/drawing/color_image.h"

namespace vitruvia {

struct ShadedMesh {
  const std::vector<Vector3f>* vertices = nullptr;   // camera frame, metres
  const std::vector<Triangle>* triangles = nullptr;  // counter-clockwise seen from outside
  std::vector<Color> colors;                         // one for all, or one per vertex
};

// A part of the camera's picture, in pixels from its top left corner (pixel (u, v) covers u … u + 1
// and v … v + 1); it may reach beyond the picture.
struct PictureWindow {
  double left = 0.0, top = 0.0, width = 0.0, height = 0.0;
};

// A software renderer. Shading and colour are computed at vertices and interpolated in the image.
// Each pixel is the mean of four samples. A view keeps its buffers from picture to picture; each
// thread has a view of its own.
class MeshView {
 public:
  MeshView(int width, int height);  // of the pictures, pixels

  // The meshes as the camera sees them in `part`, both sides of each triangle, transparent where
  // there is no surface. Triangles nearer than 0.1 m are left out.
  ColorImage Draw(const PinholeCamera& camera, const PictureWindow& part,
                  const std::vector<ShadedMesh>& meshes);

 private:
  struct Corner {
    float u = 0.0f, v = 0.0f;  // samples
    float inverse_z = 0.0f;    // 0: too near
    std::array<float, 3> color{};
  };

  void PlaceCorners(const PinholeCamera& camera, const PictureWindow& part, const ShadedMesh& mesh);
  void DrawTriangle(const Corner& a, const Corner& b, const Corner& c);
  ColorImage Averaged() const;

  int width_, height_;            // samples
  std::vector<float> inverse_z_;  // of samples; 0: nothing there
  std::vector<Color> colors_;     // of samples
  std::vector<Corner> corners_;   // of the mesh that is drawn
  std::vector<Vector3f> normals_;
};

}  // namespace vitruvia
