#include <array>
#include <vector>

#include "core/synthesis/pose.h"
#include "core/synthesis/sample_models.h"
#include "core/synthesis/sweep.h"

namespace argmesh {
namespace {

using Eigen::Vector3d;

void AddTrunk(ImplicitSurface& surface, double build) {
  surface.BeginPart("trunk");
  surface.Add(
      MakeEllipsoid(At(0, 0, 0.53), {0.09 * build, 0.068 * build, 0.07}));
  surface.Add(
      MakeEllipsoid(At(0, 0, 0.62), {0.072 * build, 0.056 * build, 0.1}), 0.06);
  surface.Add(
      MakeEllipsoid(At(0, 0.0, 0.73), {0.093 * build, 0.065 * build, 0.1}),
      0.06);
  surface.Add(MakeCapsule({-0.075, 0, 0.805}, {0.075, 0, 0.805}, 0.033, 0.033),
              0.04);
  surface.BeginPart("head");
  surface.Add(MakeCapsule({0, 0, 0.81}, {0, -0.005, 0.88}, 0.03, 0.028), 0.03);
  surface.Add(MakeEllipsoid(At(0, -0.012, 0.935), {0.05, 0.06, 0.07}), 0.015);
}

void AddArm(ImplicitSurface& surface, double side, Random& random) {
  surface.BeginPart("arms");
  const Pose shoulder = At(side * 0.108, 0, 0.8) *
                        TurnX(random.Uniform(-70, 30)) *
                        TurnY(-side * random.Uniform(14, 85));
  const Pose elbow =
      shoulder * At(0, 0, -0.165) * TurnX(random.Uniform(-85, -5));
  const Pose wrist = elbow * At(0, 0, -0.15);
  surface.Add(
      MakeCapsule(shoulder.translation(), elbow.translation(), 0.034, 0.026),
      0.025);
  surface.Add(
      MakeCapsule(elbow.translation(), wrist.translation(), 0.027, 0.018),
      0.008);
  surface.BeginPart("hands");
  surface.Add(MakeEllipsoid(wrist * At(0, 0, -0.045), {0.018, 0.026, 0.05}),
              0.012);
  surface.Add(MakeCapsule(wrist * Vector3d(0, -0.01, -0.02),
                          wrist * Vector3d(0, -0.035, -0.05), 0.013, 0.012),
              0.006);
}

void AddLeg(ImplicitSurface& surface, double side, Random& random) {
  surface.BeginPart("legs");
  const double lift = random.Uniform(-35, 25);
  const double bend = random.Uniform(0, 55);
  const Pose hip = At(side * 0.052, 0, 0.5) * TurnX(lift - 0.25 * bend) *
                   TurnY(-side * random.Uniform(3, 16));
  const Pose knee = hip * At(0, 0, -0.235) * TurnX(bend);
  const Pose ankle = knee * At(0, 0, -0.225);
  surface.Add(MakeCapsule(hip.translation(), knee.translation(), 0.058, 0.037),
              0.03);
  surface.Add(
      MakeCapsule(knee.translation(), ankle.translation(), 0.038, 0.023), 0.01);
  surface.BeginPart("feet");
  surface.Add(MakeCapsule(ankle * Vector3d(0, 0.012, -0.015),
                          ankle * Vector3d(0, -0.085, -0.022), 0.023, 0.019),
              0.012);
}

// Bent by the same angle at each of its three joints.
void AddFinger(ImplicitSurface& surface, const Pose& knuckle, double length,
               double radius, double bend) {
  Pose joint = knuckle;
  const std::array<double, 3> shares = {0.42, 0.32, 0.26};
  double start = radius;
  for (const double share : shares) {
    joint = joint * TurnX(bend);
    const Pose next = joint * At(0, 0, share * length);
    const double end = start * 0.92;
    surface.Add(
        MakeCapsule(joint.translation(), next.translation(), start, end),
        0.006);
    joint = next;
    start = end;
  }
}

}  // namespace

SampleModel MakeHuman(Random& random) {
  SampleModel model;
  AddTrunk(model.surface, random.Uniform(0.9, 1.15));
  for (const double side : {-1.0, 1.0}) {
    AddArm(model.surface, side, random);
    AddLeg(model.surface, side, random);
  }
  return model;
}

SampleModel MakeHand(Random& random) {
  const double spread = random.Uniform(5, 11);
  const double curl = random.Uniform(0, 22);
  SampleModel model;
  ImplicitSurface& surface = model.surface;
  surface.BeginPart("palm");
  surface.Add(MakeBox(At(0, 0, 0.2), {0.125, 0.02, 0.13}, 0.045));
  surface.Add(MakeBox(At(0, 0.005, -0.05), {0.05, 0.004, 0.2}, 0.055), 0.09);
  const std::array<double, 4> lengths = {0.37, 0.42, 0.39, 0.3};
  for (size_t i = 0; i < lengths.size(); ++i) {
    surface.BeginPart("fingers");
    const double place = static_cast<double>(i) - 1.5;
    const double drop = place * place * 0.008 + (i == 3 ? 0.02 : 0.0);
    const Pose knuckle =
        At(0.095 * place, 0, 0.37 - drop) * TurnY(place * spread);
    const double radius = i == 3 ? 0.038 : 0.044;
    AddFinger(surface, knuckle, lengths[i], radius,
              curl + random.Uniform(-4, 10));
  }
  surface.BeginPart("thumb");
  const Pose thumb =
      At(-0.11, -0.01, 0.1) * TurnY(-random.Uniform(40, 58)) * TurnX(10);
  AddFinger(surface, thumb, 0.36, 0.055, random.Uniform(0, 14));
  return model;
}

}  // namespace argmesh
