// SPDX-License-Identifier: Apache-2.0
#include "core/io/image.h"

#include "core/base/random.h"
#include "tests/support/shapes.h"

#include <sys/stat.h>

#include <QElapsedTimer>
#include <QTest>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>

using namespace whorl;
namespace fs = std::filesystem;

namespace {

Map noise(int width, int height, int channels, TexelFormat format) {
    Map map(width, height, channels, format, 0.0f);
    map.srgb = channels == 3 && format != TexelFormat::F32;
    std::uint64_t i = 0;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            for (int c = 0; c < channels; ++c) map.setTexel(x, y, c, randomFloat(3, i++, 0));
        }
    }
    return map;
}

double largestDifference(const Map& a, const Map& b) {
    double most = 0.0;
    for (int y = 0; y < a.height(); ++y) {
        for (int x = 0; x < a.width(); ++x) {
            for (int c = 0; c < a.channels(); ++c) {
                most = std::max(most, std::abs(double(a.texel(x, y, c)) - double(b.texel(x, y, c))));
            }
        }
    }
    return most;
}

void writeBytes(const fs::path& file, const std::string& bytes) {
    std::ofstream(file, std::ios::binary).write(bytes.data(), std::streamsize(bytes.size()));
}

std::vector<std::uint8_t> bytesOf(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

// One sentence that names the file.
bool goodSentence(const std::string& text, const std::string& name) {
    return text.find(name) != std::string::npos && text.back() == '.' && text.find('\n') == std::string::npos;
}

// A list that OpenImageIO 2.4 reads in quadratic time: minutes for this one.
QByteArray slowXmp() {
    QByteArray out = "<x:xmpmeta xmlns:x=\"adobe:ns:meta/\"><rdf:RDF><rdf:Description>";
    for (int i = 0; i < 40000; ++i) out += "<rdf:li dc:subject=\"k" + QByteArray::number(i) + "\"/>";
    return out + "</rdf:Description></rdf:RDF></x:xmpmeta>";
}

// One grey pixel, uncompressed, little-endian, with this XMP.
std::string tiffWith(const QByteArray& xmp) {
    std::string out("II*\0\x08\0\0\0\x09\0", 10);
    const auto number = [&](std::uint32_t value, int bytes) {
        for (int i = 0; i < bytes; ++i) out += char(value >> (8 * i));
    };
    constexpr std::uint32_t pixelAt = 10 + 9 * 12 + 4;
    const auto size = static_cast<std::uint32_t>(xmp.size());
    const std::uint32_t entries[9][4] = {// tag, type, count, value
                                         {256, 3, 1, 1}, {257, 3, 1, 1}, {258, 3, 1, 8},
                                         {259, 3, 1, 1}, {262, 3, 1, 1}, {273, 4, 1, pixelAt},
                                         {277, 3, 1, 1}, {279, 4, 1, 1}, {700, 1, size, pixelAt + 4}};
    for (const auto& entry : entries) {
        number(entry[0], 2);
        number(entry[1], 2);
        number(entry[2], 4);
        number(entry[3], 4);
    }
    number(0, 4);
    number(128, 4);
    return out + xmp.toStdString();
}

struct WorkerInstead {
    QByteArray before = qgetenv("WHORL_IMAGE_WORKER");
    explicit WorkerInstead(const fs::path& other) { qputenv("WHORL_IMAGE_WORKER", other.string().c_str()); }
    ~WorkerInstead() { qputenv("WHORL_IMAGE_WORKER", before); }
};

}  // namespace

class ImageTest : public QObject {
    Q_OBJECT
    fs::path m_folder;

private Q_SLOTS:
    void initTestCase() { m_folder = testing::scratchFolder("image_test"); }

    void writtenIsRead_data() {
        QTest::addColumn<QString>("suffix");
        QTest::addColumn<int>("channels");
        QTest::addColumn<int>("format");
        QTest::addColumn<int>("formatRead");
        QTest::addColumn<double>("tolerance");
        QTest::newRow("8 bit data PNG") << "png" << 1 << 0 << 0 << 0.0;
        QTest::newRow("16 bit data PNG") << "png" << 1 << 1 << 1 << 0.0;
        QTest::newRow("8 bit colour PNG") << "png" << 3 << 0 << 0 << 0.0;
        QTest::newRow("float data EXR") << "exr" << 1 << 2 << 2 << 0.0;
        QTest::newRow("float colour EXR") << "exr" << 3 << 2 << 2 << 0.0;
        QTest::newRow("float data TIFF") << "tif" << 1 << 2 << 2 << 0.0;
        QTest::newRow("16 bit colour TIFF") << "tif" << 3 << 1 << 1 << 0.0;
        QTest::newRow("8 bit data TGA") << "tga" << 1 << 0 << 0 << 0.0;
        QTest::newRow("8 bit colour TGA") << "tga" << 3 << 0 << 0 << 0.0;
        QTest::newRow("float data as PNG becomes 16 bit") << "png" << 1 << 2 << 1 << 1.0 / 65535;
    }
    void writtenIsRead() {
        QFETCH(QString, suffix);
        QFETCH(int, channels);
        QFETCH(int, format);
        QFETCH(int, formatRead);
        QFETCH(double, tolerance);
        const Map map = noise(97, 71, channels, TexelFormat(format));
        const fs::path file = m_folder / ("map." + suffix.toStdString());
        const auto written = writeImage(map, file);
        QVERIFY2(written.ok(), written ? "" : written.error().message.c_str());
        const auto read = readImage(file, channels == 3 ? ImageUse::Colour : ImageUse::Data);
        QVERIFY2(read.ok(), read ? "" : read.error().message.c_str());
        QCOMPARE(read->width(), 97);
        QCOMPARE(read->height(), 71);
        QCOMPARE(read->channels(), channels);
        QCOMPARE(int(read->format()), formatRead);
        QCOMPARE(read->srgb, channels == 3 && formatRead != 2);
        QVERIFY(largestDifference(map, *read) <= tolerance);

        const auto bytes = bytesOf(file);
        const auto fromBytes =
            readImage(bytes, "map." + suffix.toStdString(), channels == 3 ? ImageUse::Colour : ImageUse::Data);
        QVERIFY(fromBytes.ok());
        QCOMPARE(largestDifference(*read, *fromBytes), 0.0);
    }

    void jpegIsNear() {
        Map map(64, 64, 3, TexelFormat::U8, 0.5f);
        map.srgb = true;
        QVERIFY(writeImage(map, m_folder / "grey.jpg").ok());
        const auto read = readImage(m_folder / "grey.jpg", ImageUse::Colour);
        QVERIFY(read.ok());
        QVERIFY(largestDifference(map, *read) < 0.02);
    }

    void dataOfColourIsTheMean() {
        Map map(8, 8, 3, TexelFormat::U8, 0.0f);
        map.srgb = true;  // the numbers go into the file as they are
        map.setTexel(2, 3, 0, 1.0f);
        map.setTexel(2, 3, 1, 0.5f);
        QVERIFY(writeImage(map, m_folder / "mean.png").ok());
        const auto read = readImage(m_folder / "mean.png", ImageUse::Data);
        QVERIFY(read.ok());
        QCOMPARE(read->channels(), 1);
        QVERIFY(std::abs(read->texel(2, 3) - 0.5f) < 0.003f);
        QCOMPARE(read->texel(3, 3), 0.0f);
    }

    void colourOfGreyIsGrey() {
        QVERIFY(writeImage(noise(9, 9, 1, TexelFormat::U8), m_folder / "one.png").ok());
        const auto read = readImage(m_folder / "one.png", ImageUse::Colour);
        QVERIFY(read.ok());
        QCOMPARE(read->channels(), 3);
        QCOMPARE(read->texel(4, 4, 0), read->texel(4, 4, 2));
    }

    void srgbBecomesLinearInExr() {
        Map map(4, 4, 3, TexelFormat::U8, 0.5f);
        map.srgb = true;
        QVERIFY(writeImage(map, m_folder / "linear.exr").ok());
        const auto read = readImage(m_folder / "linear.exr", ImageUse::Colour);
        QVERIFY(read.ok() && !read->srgb);
        QVERIFY(std::abs(read->sampleColour({0.5f, 0.5f}).x - map.sampleColour({0.5f, 0.5f}).x) < 1e-5f);
    }

    void hiddenColoursStay() {
        // Alpha 0 must not wipe the colour: textures pad their seams there.
        const std::uint8_t pixels[] = {200, 100, 50, 0, 10, 20, 30, 255};
        QVERIFY(writePixels(pixels, 2, 1, 4, m_folder / "alpha.png").ok());
        const auto read = readImage(m_folder / "alpha.png", ImageUse::Colour);
        QVERIFY(read.ok());
        QCOMPARE(std::lround(read->texel(0, 0, 0) * 255.0f), 200L);
        QCOMPARE(std::lround(read->texel(1, 0, 2) * 255.0f), 30L);
    }

    void metadataChangesNothing_data() {
        QTest::addColumn<QString>("file");
        QTest::addColumn<int>("at");  // where a reader of the format may meet metadata first
        QTest::addColumn<QByteArray>("metadata");
        const QByteArray xmp = slowXmp();
        const auto chunk = [](const QByteArray& name, const QByteArray& data) {
            QByteArray out(4, '\0');
            for (int i = 0; i < 4; ++i) out[i] = char(data.size() >> (24 - 8 * i));
            return out + name + data + QByteArray(4, '\0');  // a wrong checksum: nobody is to look at it
        };
        QTest::newRow("PNG, XMP") << "plain.png" << 33
                                  << chunk("iTXt", "XML:com.adobe.xmp" + QByteArray(5, '\0') + xmp);
        QTest::newRow("PNG, compressed text of nonsense") << "plain.png" << 33 << chunk("zTXt", "a" + xmp);
        QTest::newRow("PNG, Exif") << "plain.png" << 33 << chunk("eXIf", "MM nonsense");
        QByteArray segment = "http://ns.adobe.com/xap/1.0/" + QByteArray(1, '\0') + xmp.left(60000);
        const auto length = segment.size() + 2;
        segment.prepend(char(length & 255)).prepend(char(length >> 8)).prepend("\xff\xe1");
        QTest::newRow("JPEG, XMP") << "plain.jpg" << 2 << segment;
    }
    void metadataChangesNothing() {
        QFETCH(QString, file);
        QFETCH(int, at);
        QFETCH(QByteArray, metadata);
        const fs::path plain = m_folder / file.toStdString();
        QVERIFY(writeImage(noise(40, 30, 3, TexelFormat::U8), plain).ok());
        auto bytes = bytesOf(plain);
        const auto expected = readImage(bytes, file.toStdString(), ImageUse::Colour);
        QVERIFY(expected.ok());
        bytes.insert(bytes.begin() + at, metadata.begin(), metadata.end());
        const auto read = readImage(bytes, file.toStdString(), ImageUse::Colour);
        QVERIFY2(read.ok(), read ? "" : read.error().message.c_str());
        QCOMPARE(read->width(), 40);
        QCOMPARE(largestDifference(*read, *expected), 0.0);
    }

    void slowHeaderIsRefused() {
        writeBytes(m_folder / "plain.tif", tiffWith("<x:xmpmeta xmlns:x=\"adobe:ns:meta/\"></x:xmpmeta>"));
        const auto plain = readImage(m_folder / "plain.tif", ImageUse::Data);
        QVERIFY2(plain.ok(), plain ? "" : plain.error().message.c_str());
        QCOMPARE(std::lround(plain->texel(0, 0) * 255.0f), 128L);

        writeBytes(m_folder / "slow.tif", tiffWith(slowXmp()));
        const auto slow = readImage(m_folder / "slow.tif", ImageUse::Data);
        QVERIFY(!slow.ok());
        QVERIFY2(goodSentence(slow.error().message, "slow.tif"), slow.error().message.c_str());
        QVERIFY2(slow.error().message.find("metadata") != std::string::npos, slow.error().message.c_str());
    }

    void pfmIsUprightAndRepaired() {
        // PFM stores its rows from the bottom.
        std::string bytes = "Pf\n2 2\n-1.0\n";
        const float rows[4] = {std::numeric_limits<float>::quiet_NaN(), -3.0f, 0.25f,
                               std::numeric_limits<float>::infinity()};
        bytes.append(reinterpret_cast<const char*>(rows), sizeof rows);
        writeBytes(m_folder / "small.pfm", bytes);
        std::vector<std::string> repairs;
        const auto read = readImage(m_folder / "small.pfm", ImageUse::Data, &repairs);
        QVERIFY2(read.ok(), read ? "" : read.error().message.c_str());
        QCOMPARE(repairs.size(), std::size_t{3});
        QCOMPARE(read->texel(0, 0), 0.25f);
        QCOMPARE(read->texel(1, 0), 0.25f);
        QCOMPARE(read->texel(0, 1), 0.0f);
        QCOMPARE(read->texel(1, 1), 0.0f);
    }

    void refused_data() {
        QTest::addColumn<QByteArray>("bytes");
        QTest::newRow("empty") << QByteArray();
        QTest::newRow("text") << QByteArray("<html>not an image</html>");
        QTest::newRow("only the PNG signature") << QByteArray("\x89PNG\r\n\x1a\n", 8);
        QTest::newRow("only the EXR magic") << QByteArray("\x76\x2f\x31\x01", 4);
        QTest::newRow("a lying PFM") << QByteArray("Pf\n16000 16000\n-1.0\nabcd");
        QTest::newRow("a PFM of no width") << QByteArray("Pf\n0 10\n-1.0\nabcd");
    }
    void refused() {
        QFETCH(QByteArray, bytes);
        writeBytes(m_folder / "bad.png", bytes.toStdString());
        const auto read = readImage(m_folder / "bad.png", ImageUse::Data);
        QVERIFY(!read.ok());
        QVERIFY2(goodSentence(read.error().message, "bad.png"), read.error().message.c_str());
    }

    void noFileFolderOrPipe() {
        QVERIFY(!readImage(m_folder / "missing.png", ImageUse::Data).ok());
        QVERIFY(!readImage(m_folder, ImageUse::Data).ok());
        QCOMPARE(mkfifo((m_folder / "pipe.png").c_str(), 0600), 0);
        QVERIFY(!readImage(m_folder / "pipe.png", ImageUse::Data).ok());
    }

    void writingIsAllOrNothing() {
        const fs::path folder = testing::scratchFolder("image_test_write");
        const Map map = noise(16, 16, 1, TexelFormat::U8);
        QVERIFY(writeImage(map, folder / "kept.png").ok());
        const auto before = bytesOf(folder / "kept.png");
        {
            const WorkerInstead broken("/bin/false");
            const auto written = writeImage(noise(8, 8, 1, TexelFormat::U8), folder / "kept.png");
            QVERIFY(!written.ok());
            QVERIFY2(goodSentence(written.error().message, "kept.png"), written.error().message.c_str());
        }
        QVERIFY(bytesOf(folder / "kept.png") == before);
        QVERIFY(!writeImage(map, folder / "no.gif").ok());
        QVERIFY(!writeImage(map, folder / "none" / "map.png").ok());
        QVERIFY(!writeImage(Map(), folder / "empty.png").ok());
        QVERIFY(!writePixels({}, 4, 4, 3, folder / "short.png").ok());
        QCOMPARE(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), std::ptrdiff_t{1});
    }

    void workerThatMisbehaves_data() {
        QTest::addColumn<QString>("worker");
        QTest::newRow("missing") << "/nowhere/worker";
        QTest::newRow("dies at once") << "/bin/false";
        QTest::newRow("says nothing") << "/bin/true";
        QTest::newRow("says something else") << "/bin/echo";
    }
    void workerThatMisbehaves() {
        QFETCH(QString, worker);
        QVERIFY(writeImage(noise(4, 4, 1, TexelFormat::U8), m_folder / "good.png").ok());
        const WorkerInstead other(worker.toStdString());
        const auto read = readImage(m_folder / "good.png", ImageUse::Data);
        QVERIFY(!read.ok());
        QVERIFY2(goodSentence(read.error().message, "good.png"), read.error().message.c_str());
    }

    void hostile() {
        const auto folder = testing::realData("hostile/image");
        if (!folder) QSKIP("the folder of hostile images is not here");
        const QMap<QString, bool> loads{{"png_1x1.png", true}, {"float_nan_inf_negative.pfm", true}};
        for (const auto& entry : fs::directory_iterator(*folder)) {
            const std::string name = entry.path().filename().string();
            std::vector<std::string> repairs;
            QElapsedTimer timer;
            timer.start();
            const auto read = readImage(entry.path(), ImageUse::Data, &repairs);
            QVERIFY2(timer.elapsed() < 4000, name.c_str());
            QVERIFY2(read.ok() == loads.contains(QString::fromStdString(name)), name.c_str());
            if (!read) QVERIFY2(goodSentence(read.error().message, name), read.error().message.c_str());
            if (name == "float_nan_inf_negative.pfm") QCOMPARE(repairs.size(), std::size_t{3});
        }
    }
};

QTEST_APPLESS_MAIN(ImageTest)
#include "image_test.moc"
