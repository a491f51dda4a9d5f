// SPDX-License-Identifier: Apache-2.0
#include "render/camera.h"

#include "core/base/random.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <QTest>
#include <cmath>

namespace whorl {
namespace {

float random(std::uint64_t index, std::uint32_t channel, float low, float high) {
    return low + (high - low) * randomFloat(7, index, channel);
}

Camera randomCamera(std::uint64_t i) {
    Camera camera;
    camera.target = glm::vec3(random(i, 0, -1, 1), random(i, 1, -1, 1), random(i, 2, -1, 1));
    camera.distance = random(i, 3, 0.2f, 3.0f);
    camera.azimuth = random(i, 4, -3.1f, 3.1f);
    camera.elevation = random(i, 5, -1.5f, 1.5f);
    return camera;
}

Bounds randomBounds(std::uint64_t i) {
    Bounds bounds;
    for (std::uint32_t k = 0; k < 2; ++k) {
        bounds.add(
            glm::vec3(random(i, 10 + k, -0.5f, 0.5f), random(i, 20 + k, 0.0f, 2.0f), random(i, 30 + k, -0.5f, 0.5f)));
    }
    return bounds;
}

glm::vec3 ndc(const glm::mat4& clipFromGroom, const glm::vec3& p) {
    const glm::vec4 clip = clipFromGroom * glm::vec4(p, 1.0f);
    return glm::vec3(clip) / clip.w;
}

}  // namespace

class CameraTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void targetIsInTheMiddle() {
        for (std::uint64_t i = 0; i < 200; ++i) {
            const Camera camera = randomCamera(i);
            Bounds bounds = randomBounds(i);
            bounds.add(camera.target);
            const glm::mat4 clip = camera.clipFromView(glm::vec2(640, 480), bounds) * camera.viewFromGroom();
            const glm::vec3 middle = ndc(clip, camera.target);
            QVERIFY(std::abs(middle.x) < 1e-3f && std::abs(middle.y) < 1e-3f);
            QVERIFY(std::abs(glm::length(camera.eye() - camera.target) - camera.distance) < 1e-4f * camera.distance);
        }
    }

    void projectingAndBackIsTheSame() {
        const glm::vec2 viewport(800, 600);
        for (std::uint64_t i = 0; i < 200; ++i) {
            const Camera camera = randomCamera(i);
            Bounds bounds;
            bounds.add(camera.target - glm::vec3(0.1f));
            bounds.add(camera.target + glm::vec3(0.1f));
            const StrokeView view = camera.strokeView(viewport, bounds);
            const glm::vec3 point = camera.target + glm::vec3(random(i, 40, -0.1f, 0.1f), random(i, 41, -0.1f, 0.1f),
                                                              random(i, 42, -0.1f, 0.1f));
            const glm::vec3 projected = ndc(view.clipFromGroom, point);
            const glm::vec4 back = glm::inverse(view.clipFromGroom) * glm::vec4(projected, 1.0f);
            QVERIFY(glm::length(glm::vec3(back) / back.w - point) < 2e-4f);
            // The ray from the eye through the pixel passes the point.
            const auto pixel = view.pixelFromGroom(point);
            QVERIFY(pixel.has_value());
            const glm::vec3 way = point - view.eyeGroom;
            const glm::vec3 ray = view.rayDirection(*pixel);
            QVERIFY(glm::length(way - ray * glm::dot(way, ray)) < 1e-3f);
        }
    }

    void sceneLiesBetweenThePlanes() {
        for (std::uint64_t i = 0; i < 200; ++i) {
            const Bounds bounds = randomBounds(i);
            Camera camera = randomCamera(i);
            camera.frame(bounds, glm::vec2(640, 480));
            const glm::mat4 clip = camera.clipFromView(glm::vec2(640, 480), bounds) * camera.viewFromGroom();
            for (int corner = 0; corner < 8; ++corner) {
                const glm::vec3 p((corner & 1) != 0 ? bounds.min.x : bounds.max.x,
                                  (corner & 2) != 0 ? bounds.min.y : bounds.max.y,
                                  (corner & 4) != 0 ? bounds.min.z : bounds.max.z);
                const glm::vec3 place = ndc(clip, p);
                QVERIFY(place.z >= -1.0f && place.z <= 1.0f);
                // Framing puts all corners into the picture, and not far from its edge.
                QVERIFY(std::abs(place.x) <= 1.0f && std::abs(place.y) <= 1.0f);
            }
        }
    }

    void framingFillsTheView() {
        Bounds bounds;
        bounds.add(glm::vec3(-0.1f, 1.0f, -0.1f));
        bounds.add(glm::vec3(0.1f, 1.3f, 0.1f));
        for (const glm::vec2 viewport : {glm::vec2(1000, 1000), glm::vec2(1600, 400), glm::vec2(300, 900)}) {
            Camera camera;
            camera.frame(bounds, viewport);
            const glm::mat4 clip = camera.clipFromView(viewport, bounds) * camera.viewFromGroom();
            const glm::vec3 high = ndc(clip, glm::vec3(0.1f, 1.3f, 0.1f));
            QVERIFY(std::max(high.x, high.y) > 0.85f);
            QVERIFY(std::max(high.x, high.y) <= 1.0f);
        }
    }

    void namedViewsLookFromTheirSide() {
        Bounds bounds;
        bounds.add(glm::vec3(-1));
        bounds.add(glm::vec3(1));
        const glm::vec2 viewport(500, 500);
        const auto eye = [&](std::string_view name) { return Camera::named(name, bounds, viewport)->eye(); };
        QVERIFY(eye("front").z > 2 && std::abs(eye("front").x) < 1e-4f);
        QVERIFY(eye("back").z < -2);
        QVERIFY(eye("left").x > 2 && eye("side") == eye("left"));
        QVERIFY(eye("right").x < -2);
        QVERIFY(eye("top").y > 2);
        QVERIFY(eye("three-quarter").x > 0 && eye("three-quarter").z > 0);
        QCOMPARE(Camera::named("30,10", bounds, viewport)->azimuth, 30.0f * 3.14159265f / 180.0f);
        QVERIFY(eye("0,-20").y < 0);
    }

    void unknownViewsAreRefused() {
        for (const char* name : {"", "front ", "nan,1", "1", "1,", ",1", "1,2,3", "inf,0", "1;2", "x,y"}) {
            const Result<Camera> camera = Camera::named(name, Bounds{}, glm::vec2(10, 10));
            QVERIFY2(!camera, name);
            QVERIFY(camera.error().message.find("three-quarter") != std::string::npos);
        }
    }

    void movingIsReversible() {
        Camera camera = randomCamera(3);
        camera.elevation = 0.2f;
        const Camera before = camera;
        camera.orbit(glm::vec2(30, -12));
        camera.orbit(glm::vec2(-30, 12));
        camera.pan(glm::vec2(11, 5), glm::vec2(640, 480));
        camera.pan(glm::vec2(-11, -5), glm::vec2(640, 480));
        camera.zoom(1.5f);
        camera.zoom(1.0f / 1.5f);
        QVERIFY(glm::length(camera.eye() - before.eye()) < 1e-4f);
        camera.zoom(0.0f);
        camera.zoom(-1.0f);
        QVERIFY(std::abs(camera.distance - before.distance) < 1e-4f);
        camera.orbit(glm::vec2(0, 1e6f));
        QVERIFY(camera.elevation < 1.5708f);
    }

    void panFollowsThePointer() {
        Camera camera;
        const glm::vec2 viewport(640, 480);
        Bounds bounds;
        bounds.add(glm::vec3(-0.2f));
        bounds.add(glm::vec3(0.2f));
        const glm::vec3 point = camera.target;
        camera.pan(glm::vec2(64, -48), viewport);
        const auto pixel = camera.strokeView(viewport, bounds).pixelFromGroom(point);
        QVERIFY(pixel.has_value());
        // To the right and up by as much as the pointer moved (y grows downwards).
        QVERIFY(glm::length(*pixel - glm::vec2(320 + 64, 240 - 48)) < 0.5f);
    }
};

}  // namespace whorl

QTEST_APPLESS_MAIN(whorl::CameraTest)
#include "camera_test.moc"
