// SPDX-License-Identifier: Apache-2.0
#include "editor/app/icons.h"

#include <QApplication>
#include <QHash>
#include <QIconEngine>
#include <QPainter>
#include <QPainterPath>
#include <QPalette>
#include <cmath>

namespace whorl {
namespace {

// Drawn in a square of 24 units, lines 1.7 wide with round ends.
using Draw = void (*)(QPainterPath& lines, QPainterPath& fill);

void polyline(QPainterPath& path, std::initializer_list<QPointF> points) {
    bool first = true;
    for (const QPointF& p : points) {
        first ? path.moveTo(p) : path.lineTo(p);
        first = false;
    }
}

void arrowHead(QPainterPath& path, QPointF tip, double dx, double dy) {
    polyline(path, {QPointF(tip.x() - dx - dy, tip.y() - dy + dx), tip, QPointF(tip.x() - dx + dy, tip.y() - dy - dx)});
}

const QHash<QString, Draw>& drawings() {
    static const QHash<QString, Draw> all{
        {"comb",
         [](QPainterPath& l, QPainterPath&) {
             l.addRoundedRect(3, 4, 18, 5, 2, 2);
             for (int i = 0; i < 6; ++i) polyline(l, {QPointF(4.5 + 3 * i, 9), QPointF(4.5 + 3 * i, 19.5)});
         }},
        {"cut",
         [](QPainterPath& l, QPainterPath&) {
             l.addEllipse(QPointF(6, 17.5), 3, 3);
             l.addEllipse(QPointF(18, 17.5), 3, 3);
             polyline(l, {QPointF(7.6, 15), QPointF(16.5, 3)});
             polyline(l, {QPointF(16.4, 15), QPointF(7.5, 3)});
         }},
        {"grow",
         [](QPainterPath& l, QPainterPath&) {
             polyline(l, {QPointF(3, 21), QPointF(21, 21)});
             polyline(l, {QPointF(12, 18), QPointF(12, 4)});
             arrowHead(l, {12, 3.5}, 0, -4);
             polyline(l, {QPointF(5, 18), QPointF(5, 12)});
             polyline(l, {QPointF(19, 18), QPointF(19, 12)});
         }},
        {"smooth",
         [](QPainterPath& l, QPainterPath&) {
             for (int i = 0; i < 3; ++i) {
                 const double y = 7 + 5 * i;
                 l.moveTo(3, y);
                 l.cubicTo(8, y - 5, 16, y + 5, 21, y);
             }
         }},
        {"group",
         [](QPainterPath& l, QPainterPath& f) {
             l.addEllipse(QPointF(9, 9.5), 6, 6);
             f.addEllipse(QPointF(15, 15), 6.2, 6.2);
         }},
        {"paint",
         [](QPainterPath& l, QPainterPath& f) {
             polyline(l, {QPointF(20.5, 3.5), QPointF(11, 13)});
             f.moveTo(11.5, 12.5);
             f.cubicTo(8, 10.5, 4.5, 14, 6, 17);
             f.cubicTo(6, 19, 4.5, 20, 3, 20.3);
             f.cubicTo(7, 22, 13.5, 20.5, 13, 15.5);
             f.closeSubpath();
         }},
        {"add",
         [](QPainterPath& l, QPainterPath&) {
             l.moveTo(7, 21);
             l.cubicTo(5, 15, 6, 9, 10, 4);
             polyline(l, {QPointF(17, 8), QPointF(17, 16)});
             polyline(l, {QPointF(13, 12), QPointF(21, 12)});
         }},
        {"delete",
         [](QPainterPath& l, QPainterPath&) {
             l.moveTo(7, 21);
             l.cubicTo(5, 15, 6, 9, 10, 4);
             polyline(l, {QPointF(14, 9), QPointF(20.5, 15.5)});
             polyline(l, {QPointF(20.5, 9), QPointF(14, 15.5)});
         }},
        {"puff",
         [](QPainterPath& l, QPainterPath&) {
             for (int i = 0; i < 5; ++i) {
                 const double a = 3.14159 * (0.12 + 0.19 * i);
                 polyline(l, {QPointF(12 - 4 * std::cos(a), 20 - 4 * std::sin(a)),
                              QPointF(12 - 14 * std::cos(a) * 0.75, 20 - 16 * std::sin(a))});
             }
             polyline(l, {QPointF(3, 21), QPointF(21, 21)});
         }},
        {"look",
         [](QPainterPath& l, QPainterPath& f) {
             l.moveTo(2.5, 12);
             l.cubicTo(7, 4.5, 17, 4.5, 21.5, 12);
             l.cubicTo(17, 19.5, 7, 19.5, 2.5, 12);
             f.addEllipse(QPointF(12, 12), 3, 3);
         }},
        {"guides",
         [](QPainterPath& l, QPainterPath& f) {
             for (int i = 0; i < 3; ++i) {
                 const double x = 5 + 6.5 * i;
                 l.moveTo(x, 19);
                 l.cubicTo(x - 2, 13, x + 3, 10, x + 1, 4);
                 f.addEllipse(QPointF(x, 20), 1.7, 1.7);
             }
         }},
        {"new",
         [](QPainterPath& l, QPainterPath&) {
             polyline(l, {QPointF(13.5, 3), QPointF(5, 3), QPointF(5, 21), QPointF(19, 21), QPointF(19, 8.5),
                          QPointF(13.5, 3), QPointF(13.5, 8.5), QPointF(19, 8.5)});
         }},
        {"open",
         [](QPainterPath& l, QPainterPath&) {
             polyline(l, {QPointF(3, 19), QPointF(3, 5), QPointF(9, 5), QPointF(11, 7.5), QPointF(19, 7.5),
                          QPointF(19, 10.5)});
             polyline(l, {QPointF(3, 19), QPointF(6.5, 10.5), QPointF(22, 10.5), QPointF(18.5, 19), QPointF(3, 19)});
         }},
        {"save",
         [](QPainterPath& l, QPainterPath&) {
             polyline(l,
                      {QPointF(4, 4), QPointF(16, 4), QPointF(20, 8), QPointF(20, 20), QPointF(4, 20), QPointF(4, 4)});
             polyline(l, {QPointF(8, 4), QPointF(8, 9), QPointF(15, 9), QPointF(15, 4)});
             polyline(l, {QPointF(7, 20), QPointF(7, 14), QPointF(17, 14), QPointF(17, 20)});
         }},
        {"export",
         [](QPainterPath& l, QPainterPath&) {
             polyline(l, {QPointF(9, 6), QPointF(4, 6), QPointF(4, 20), QPointF(18, 20), QPointF(18, 15)});
             l.moveTo(9, 15);
             l.cubicTo(9, 10, 13, 8, 20, 8);
             arrowHead(l, {20.5, 8}, 4, 0);
         }},
        {"camera",
         [](QPainterPath& l, QPainterPath&) {
             l.addRoundedRect(3, 7, 18, 13, 2, 2);
             l.addEllipse(QPointF(12, 13.5), 3.7, 3.7);
             polyline(l, {QPointF(8, 7), QPointF(9.5, 4), QPointF(14.5, 4), QPointF(16, 7)});
         }},
        {"undo",
         [](QPainterPath& l, QPainterPath&) {
             l.moveTo(4, 9);
             l.lineTo(14.5, 9);
             l.cubicTo(22, 9, 22, 19, 14.5, 19);
             l.lineTo(9, 19);
             arrowHead(l, {3.5, 9}, -4, 0);
         }},
        {"redo",
         [](QPainterPath& l, QPainterPath&) {
             l.moveTo(20, 9);
             l.lineTo(9.5, 9);
             l.cubicTo(2, 9, 2, 19, 9.5, 19);
             l.lineTo(15, 19);
             arrowHead(l, {20.5, 9}, 4, 0);
         }},
        {"parting",
         [](QPainterPath& l, QPainterPath&) {
             polyline(l, {QPointF(12, 3), QPointF(12, 21)});
             for (int i = 0; i < 3; ++i) {
                 const double y = 5 + 5.5 * i;
                 l.moveTo(9.5, y);
                 l.cubicTo(6.5, y, 4, y + 2, 3.5, y + 5);
                 l.moveTo(14.5, y);
                 l.cubicTo(17.5, y, 20, y + 2, 20.5, y + 5);
             }
         }},
        {"sketch",
         [](QPainterPath& l, QPainterPath&) {
             l.moveTo(3, 19);
             l.cubicTo(5, 9, 10, 16, 19, 6);
             arrowHead(l, {20.5, 4.5}, 4, -4);
         }},
        {"attract",
         [](QPainterPath& l, QPainterPath& f) {
             f.addEllipse(QPointF(12, 12), 2.2, 2.2);
             for (const double x : {-1.0, 1.0}) {
                 polyline(l, {QPointF(12 + 9.5 * x, 12), QPointF(12 + 5 * x, 12)});
                 arrowHead(l, {12 + 4.5 * x, 12}, -3 * x, 0);
                 polyline(l, {QPointF(12, 12 + 9.5 * x), QPointF(12, 12 + 5 * x)});
                 arrowHead(l, {12, 12 + 4.5 * x}, 0, -3 * x);
             }
         }},
        {"repel",
         [](QPainterPath& l, QPainterPath& f) {
             f.addEllipse(QPointF(12, 12), 2.2, 2.2);
             for (const double x : {-1.0, 1.0}) {
                 polyline(l, {QPointF(12 + 4.5 * x, 12), QPointF(12 + 9 * x, 12)});
                 arrowHead(l, {12 + 9.5 * x, 12}, 3 * x, 0);
                 polyline(l, {QPointF(12, 12 + 4.5 * x), QPointF(12, 12 + 9 * x)});
                 arrowHead(l, {12, 12 + 9.5 * x}, 0, 3 * x);
             }
         }},
        {"whorl",
         [](QPainterPath& l, QPainterPath&) {
             l.moveTo(12, 12);
             l.cubicTo(15, 8, 18, 14, 12.5, 16);
             l.cubicTo(6, 18, 4, 8, 11, 6);
             l.cubicTo(18, 4, 23, 12, 19, 19);
         }},
        {"move_stroke",
         [](QPainterPath& l, QPainterPath&) {
             l.moveTo(3, 14);
             l.cubicTo(4, 7, 8, 11, 12, 4);
             l.moveTo(9, 20);
             l.cubicTo(10, 13, 14, 17, 18, 10);
             polyline(l, {QPointF(13, 10), QPointF(19, 17)});
             arrowHead(l, {20, 18.5}, 3, 3.5);
         }},
        {"align_strokes",
         [](QPainterPath& l, QPainterPath&) {
             for (int i = 0; i < 3; ++i) {
                 const double y = 6 + 6 * i;
                 l.moveTo(3, y);
                 l.cubicTo(8, y - 3, 12, y + 3, 18, y);
                 arrowHead(l, {20, y}, 3, 0);
             }
         }},
        {"mirror",
         [](QPainterPath& l, QPainterPath& f) {
             for (int i = 0; i < 4; ++i) polyline(l, {QPointF(12, 3 + 5 * i), QPointF(12, 5.5 + 5 * i)});
             polyline(l, {QPointF(9, 6), QPointF(9, 18), QPointF(2.5, 18), QPointF(9, 6)});
             polyline(f, {QPointF(15, 6), QPointF(15, 18), QPointF(21.5, 18), QPointF(15, 6)});
         }},
        {"frame",
         [](QPainterPath& l, QPainterPath& f) {
             polyline(l, {QPointF(3, 8), QPointF(3, 3), QPointF(8, 3)});
             polyline(l, {QPointF(16, 3), QPointF(21, 3), QPointF(21, 8)});
             polyline(l, {QPointF(21, 16), QPointF(21, 21), QPointF(16, 21)});
             polyline(l, {QPointF(8, 21), QPointF(3, 21), QPointF(3, 16)});
             f.addEllipse(QPointF(12, 12), 3.2, 3.2);
         }},
        {"reset",
         [](QPainterPath& l, QPainterPath&) {
             l.arcMoveTo(4, 4, 16, 16, 140);
             l.arcTo(4, 4, 16, 16, 140, -290);
             polyline(l, {QPointF(5, 2.5), QPointF(5.5, 8), QPointF(11, 7.5)});
         }},
        {"map",
         [](QPainterPath& l, QPainterPath& f) {
             l.addRect(3.5, 3.5, 17, 17);
             f.addRect(4, 4, 8, 8);
             f.addRect(12, 12, 8, 8);
         }},
        {"plus",
         [](QPainterPath& l, QPainterPath&) {
             polyline(l, {QPointF(12, 5), QPointF(12, 19)});
             polyline(l, {QPointF(5, 12), QPointF(19, 12)});
         }},
        {"minus",
         [](QPainterPath& l, QPainterPath&) {
             polyline(l, {QPointF(5, 12), QPointF(19, 12)});
         }},
        {"up",
         [](QPainterPath& l, QPainterPath&) {
             polyline(l, {QPointF(12, 19), QPointF(12, 5)});
             polyline(l, {QPointF(6, 11), QPointF(12, 5), QPointF(18, 11)});
         }},
        {"down",
         [](QPainterPath& l, QPainterPath&) {
             polyline(l, {QPointF(12, 5), QPointF(12, 19)});
             polyline(l, {QPointF(6, 13), QPointF(12, 19), QPointF(18, 13)});
         }},
        {"close",
         [](QPainterPath& l, QPainterPath&) {
             polyline(l, {QPointF(6, 6), QPointF(18, 18)});
             polyline(l, {QPointF(18, 6), QPointF(6, 18)});
         }},
    };
    return all;
}

/// Several brushes share a meaning; their ids come from core.
QString drawingOf(const QString& name) {
    static const QHash<QString, QString> same{
        {"scissors", "cut"},        {"add_guide", "add"},        {"add-guide", "add"},
        {"place", "add"},           {"delete_guide", "delete"},  {"add-guides", "add"},
        {"delete-guide", "delete"}, {"delete-guides", "delete"}, {"remove", "delete"},
        {"erase", "delete"},        {"length", "grow"},          {"paint_map", "paint"},
        {"density", "paint"},       {"paint-density", "paint"},  {"lift", "puff"}};
    return same.value(name, name);
}

class VectorIcon : public QIconEngine {
public:
    explicit VectorIcon(QString name) : m_name(std::move(name)) {}

    void paint(QPainter* painter, const QRect& rect, QIcon::Mode mode, QIcon::State state) override {
        const QPalette palette = QApplication::palette();
        const auto group = mode == QIcon::Disabled ? QPalette::Disabled : QPalette::Active;
        const QColor colour = palette.color(
            group, state == QIcon::On || mode == QIcon::Selected ? QPalette::HighlightedText : QPalette::ButtonText);
        painter->save();
        painter->setRenderHint(QPainter::Antialiasing);
        painter->translate(rect.topLeft());
        painter->scale(rect.width() / 24.0, rect.height() / 24.0);
        if (const Draw draw = drawings().value(drawingOf(m_name))) {
            QPainterPath lines;
            QPainterPath fill;
            draw(lines, fill);
            painter->fillPath(fill, colour);
            painter->strokePath(lines, QPen(colour, 1.7, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
        } else {
            painter->setPen(QPen(colour, 1.5));
            painter->drawEllipse(QPointF(12, 12), 9.5, 9.5);
            QFont font = painter->font();
            font.setPixelSize(12);
            font.setBold(true);
            painter->setFont(font);
            painter->drawText(QRectF(0, 0, 24, 24), Qt::AlignCenter, m_name.left(1).toUpper());
        }
        painter->restore();
    }

    QPixmap pixmap(const QSize& size, QIcon::Mode mode, QIcon::State state) override {
        QPixmap picture(size);
        picture.fill(Qt::transparent);
        QPainter painter(&picture);
        paint(&painter, QRect(QPoint(), size), mode, state);
        return picture;
    }

    QIconEngine* clone() const override { return new VectorIcon(m_name); }

private:
    QString m_name;
};

}  // namespace

QIcon icon(const QString& name) {
    return QIcon(new VectorIcon(name));
}

QIcon programIcon() {
    QPixmap picture(256, 256);
    picture.fill(Qt::transparent);
    QPainter painter(&picture);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(Qt::NoPen);
    painter.setBrush(QColor("#25272b"));
    painter.drawRoundedRect(8, 8, 240, 240, 52, 52);
    // Strands that turn out of one place, as hair does at the crown.
    for (int strand = 0; strand < 9; ++strand) {
        QPainterPath path;
        for (int step = 0; step <= 40; ++step) {
            const double t = step / 40.0;
            const double angle = strand * 2 * M_PI / 9 + 2.6 * t;
            const double radius = 8 + 92 * t;
            const QPointF p(128 + radius * std::cos(angle), 128 + radius * std::sin(angle));
            step == 0 ? path.moveTo(p) : path.lineTo(p);
        }
        painter.strokePath(path, QPen(QColor::fromHslF(0.08f, 0.5f, 0.45f + 0.04f * static_cast<float>(strand % 4)), 11,
                                      Qt::SolidLine, Qt::RoundCap));
    }
    return QIcon(picture);
}

}  // namespace whorl
