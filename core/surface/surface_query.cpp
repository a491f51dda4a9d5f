// SPDX-License-Identifier: Apache-2.0
#include "core/surface/surface_query.h"

#include "core/surface/closest_point.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace whorl {
namespace {

RTCScene sceneOf(void* scene) {
    return static_cast<RTCScene>(scene);
}

bool isFinite(const glm::vec3& p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

// State of one nearest-point query. The winner is the least (distance, triangle), whatever order Embree asks in.
struct NearestSearch {
    const SurfaceMesh& mesh;
    Vec3d position;
    float best;  // squared; rounded to float, so that places shared by triangles tie although they were computed twice
    std::uint32_t triangle = ~0u;
    ClosestPoint place{};
};

bool visitTriangle(RTCPointQueryFunctionArguments* arguments) {
    auto& search = *static_cast<NearestSearch*>(arguments->userPtr);
    const glm::uvec3 t = search.mesh.triangles[arguments->primID];
    const auto& positions = search.mesh.positions;
    const ClosestPoint place =
        closestPoint(Vec3d(positions[t.x]), Vec3d(positions[t.y]), Vec3d(positions[t.z]), search.position);
    const auto distance = static_cast<float>(place.distanceSquared);
    if (!(distance < search.best || (distance == search.best && arguments->primID < search.triangle))) return false;
    search.best = distance;
    search.triangle = arguments->primID;
    search.place = place;
    // A little more than the distance: Embree measures boxes in float, and a tie must still be visited.
    const auto radius =
        static_cast<float>(std::sqrt(place.distanceSquared) * (1.0 + 4e-6)) + std::numeric_limits<float>::min();
    if (!(radius < arguments->query->radius)) return false;
    arguments->query->radius = radius;
    return true;
}

// The same place on the triangle in our own arithmetic; nothing when the ray runs along its plane.
std::optional<SurfacePoint> placeOnRay(const SurfaceMesh& mesh, std::uint32_t triangle, const Vec3d& origin,
                                       const Vec3d& direction) {
    const glm::uvec3 t = mesh.triangles[triangle];
    const Vec3d a(mesh.positions[t.x]);
    const Vec3d ab = Vec3d(mesh.positions[t.y]) - a;
    const Vec3d ac = Vec3d(mesh.positions[t.z]) - a;
    const Vec3d across = glm::cross(direction, ac);
    const double determinant = glm::dot(ab, across);
    if (determinant == 0.0) return std::nullopt;
    const Vec3d ao = origin - a;
    double u = std::max(glm::dot(ao, across) / determinant, 0.0);
    double v = std::max(glm::dot(direction, glm::cross(ao, ab)) / determinant, 0.0);
    if (!std::isfinite(u) || !std::isfinite(v)) return std::nullopt;
    if (const double sum = u + v; sum > 1.0) {
        u /= sum;
        v /= sum;
    }
    return SurfacePoint{triangle, static_cast<float>(u), static_cast<float>(v)};
}

// Rounding to float must not leave the triangle.
SurfacePoint clampedToTriangle(SurfacePoint point) {
    point.u = std::clamp(point.u, 0.0f, 1.0f);
    point.v = std::clamp(point.v, 0.0f, 1.0f - point.u);
    return point;
}

}  // namespace

SurfaceQuery::SurfaceQuery(Cow<SurfaceMesh> mesh) : m_mesh(std::move(mesh)) {
    const SurfaceMesh& data = *m_mesh;
    if (data.triangles.empty() || data.positions.empty()) return;
    RTCDevice device = rtcNewDevice("start_threads=0,set_affinity=0");
    if (!device) return;
    RTCScene scene = rtcNewScene(device);
    // Robust: no ray slips through between two triangles.
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    // Copies in Embree's own memory: it reads a few bytes past the last vertex.
    void* positions = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3),
                                              data.positions.size());
    void* triangles = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(glm::uvec3),
                                              data.triangles.size());
    if (positions && triangles) {
        std::memcpy(positions, data.positions.data(), data.positions.size() * sizeof(glm::vec3));
        std::memcpy(triangles, data.triangles.data(), data.triangles.size() * sizeof(glm::uvec3));
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene, geometry);
    }
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene);
    m_device = device;
    m_scene = scene;
}

SurfaceQuery::~SurfaceQuery() {
    if (m_scene) rtcReleaseScene(sceneOf(m_scene));
    if (m_device) rtcReleaseDevice(static_cast<RTCDevice>(m_device));
}

std::optional<SurfaceHit> SurfaceQuery::raycast(const glm::vec3& origin, const glm::vec3& direction,
                                                float maxDistance) const {
    if (!m_scene || !isFinite(origin) || !isFinite(direction) || !(maxDistance >= 0.0f)) return std::nullopt;
    const double length = glm::length(Vec3d(direction));
    if (!(length > 0.0)) return std::nullopt;
    const Vec3d unit = Vec3d(direction) / length;

    RTCRayHit ray{};
    ray.ray.org_x = origin.x;
    ray.ray.org_y = origin.y;
    ray.ray.org_z = origin.z;
    ray.ray.dir_x = static_cast<float>(unit.x);
    ray.ray.dir_y = static_cast<float>(unit.y);
    ray.ray.dir_z = static_cast<float>(unit.z);
    ray.ray.tfar = maxDistance;
    ray.ray.mask = ~0u;
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    ray.hit.primID = RTC_INVALID_GEOMETRY_ID;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(sceneOf(m_scene), &context, &ray);
    if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;

    const SurfacePoint rough{ray.hit.primID, ray.hit.u, ray.hit.v};
    SurfaceHit hit;
    hit.point = clampedToTriangle(placeOnRay(*m_mesh, rough.triangle, Vec3d(origin), unit).value_or(rough));
    hit.position = positionAt(*m_mesh, hit.point);
    hit.distance = static_cast<float>(std::max(glm::dot(Vec3d(hit.position) - Vec3d(origin), unit), 0.0));
    return hit;
}

std::optional<SurfaceHit> SurfaceQuery::nearest(const glm::vec3& position, float maxDistance) const {
    if (!m_scene || !isFinite(position) || !(maxDistance >= 0.0f)) return std::nullopt;
    NearestSearch search{*m_mesh, Vec3d(position), maxDistance * maxDistance};
    RTCPointQuery query{};
    query.x = position.x;
    query.y = position.y;
    query.z = position.z;
    // Squares of larger numbers do not fit a float.
    query.radius = maxDistance < 1e18f ? maxDistance * (1.0f + 4e-6f) + std::numeric_limits<float>::min()
                                       : std::numeric_limits<float>::infinity();
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    rtcPointQuery(sceneOf(m_scene), &query, &context, &visitTriangle, &search);
    if (search.triangle == ~0u) return std::nullopt;

    SurfaceHit hit;
    hit.point =
        clampedToTriangle({search.triangle, static_cast<float>(search.place.u), static_cast<float>(search.place.v)});
    hit.position = positionAt(*m_mesh, hit.point);
    hit.distance = static_cast<float>(std::sqrt(search.place.distanceSquared));
    return hit;
}

}  // namespace whorl
