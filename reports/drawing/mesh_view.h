// Lit meshes seen by a pinhole camera.
#pragma once

#include <memory>
#include <vector>

#include "geometry/camera.h"
#include "geometry/mesh.h"
#include "reports/drawing/offscreen.h"

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

// A picture with transparent parts laid on white paper.
ColorImage OnWhite(ColorImage image);

class MeshView {
 public:
  MeshView(int width, int height);  // of the pictures, pixels
  ~MeshView();

  // The meshes as the camera sees them in `part`, transparent where nothing is.
  ColorImage Draw(const PinholeCamera& camera, const PictureWindow& part,
                  const std::vector<ShadedMesh>& meshes);

 private:
  struct Scene;
  std::unique_ptr<Scene> scene_;
};

}  // namespace vitruvia
