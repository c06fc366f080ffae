//! The picture of the nominal layout: where the keys of a truck and of a car act, drawn to scale from the
//! default values.

use std::fmt::Write;

use car::Parameters as Car;
use study::car::builtin;
use truck::Parameters as Truck;

const INCH: f64 = 0.0254;

/// A view: where its origin is on the sheet, and its scale, both in px.
struct View {
    origin: [f64; 2],
    scale: f64,
}

/// The sheet.
struct Sheet {
    svg: String,
}

impl View {
    /// Returns a place (in, to the right and up) on the sheet.
    fn at(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [self.origin[0] + self.scale * x, self.origin[1] - self.scale * y]
    }
}

impl Sheet {
    fn shape(&mut self, view: &View, points: &[[f64; 2]], class: &str) {
        let points: Vec<String> = points
            .iter()
            .map(|own| {
                let [x, y] = view.at(*own);
                format!("{x:.1},{y:.1}")
            })
            .collect();
        let _ = writeln!(
            self.svg,
            "<polygon class=\"{class}\" points=\"{}\"/>",
            points.join(" ")
        );
    }

    /// A rectangle from one corner to the other.
    fn block(&mut self, view: &View, [a, b]: [[f64; 2]; 2], class: &str) {
        self.shape(view, &[a, [b[0], a[1]], b, [a[0], b[1]]], class);
    }

    fn line(&mut self, view: &View, [a, b]: [[f64; 2]; 2], class: &str) {
        let ([x1, y1], [x2, y2]) = (view.at(a), view.at(b));
        let _ = writeln!(
            self.svg,
            "<line class=\"{class}\" x1=\"{x1:.1}\" y1=\"{y1:.1}\" x2=\"{x2:.1}\" y2=\"{y2:.1}\"/>"
        );
    }

    fn circle(&mut self, view: &View, at: [f64; 2], radius: f64, class: &str) {
        let [x, y] = view.at(at);
        let r = view.scale * radius;
        let _ = writeln!(
            self.svg,
            "<circle class=\"{class}\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{r:.1}\"/>"
        );
    }

    fn text(&mut self, [x, y]: [f64; 2], anchor: &str, text: &str) {
        let _ = writeln!(
            self.svg,
            "<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"{anchor}\">{text}</text>"
        );
    }

    /// A coil spring standing upright.
    fn coil(&mut self, view: &View, [x, low, high]: [f64; 3], half: f64) {
        let points: Vec<String> = (0..=12)
            .map(|k| {
                let aside = [half, -half][k % 2];
                let [x, y] = view.at([x + aside, low + (high - low) * k as f64 / 12.0]);
                format!("{x:.1},{y:.1}")
            })
            .collect();
        let _ = writeln!(
            self.svg,
            "<polyline class=\"coil\" points=\"{}\"/>",
            points.join(" ")
        );
    }

    /// A dimension between two places across, at a height.
    fn across(&mut self, view: &View, [from, to]: [f64; 2], height: f64, words: &str) {
        for x in [from, to] {
            self.line(view, [[x, height - 0.7], [x, height + 0.7]], "dimension");
        }
        self.line(view, [[from, height], [to, height]], "dimension");
        let [x, y] = view.at([0.5 * (from + to), height]);
        self.text([x, y - 4.0], "middle", words);
    }

    /// A height above a level, at a place across; the words stand on that side of it.
    fn up(&mut self, view: &View, [from, to]: [f64; 2], x: f64, (anchor, words): (&str, &str)) {
        for y in [from, to] {
            self.line(view, [[x - 0.7, y], [x + 0.7, y]], "dimension");
        }
        self.line(view, [[x, from], [x, to]], "dimension");
        let [left, y] = view.at([x, to]);
        let aside = if anchor == "start" { 6.0 } else { -6.0 };
        self.text([left + aside, y + 4.0], anchor, words);
    }

    /// Words that point to a place.
    fn pointer(&mut self, view: &View, at: [f64; 2], words_at: [f64; 2], (anchor, words): (&str, &str)) {
        self.line(view, [at, words_at], "pointer");
        self.circle(view, at, 0.35, "dot");
        let [x, y] = view.at(words_at);
        let aside = if anchor == "start" { 4.0 } else { -4.0 };
        self.text([x + aside, y + 4.0], anchor, words);
    }
}

/// Returns the picture as SVG.
pub fn picture() -> String {
    let mut sheet = Sheet {
        svg:
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 1180 1330\" font-family=\"sans-serif\" \
              font-size=\"12\">\n<style>.body{fill:#d9e2ec;stroke:#334e68}.frame{fill:#efe6d8;stroke:#8a6d3b}\
              .wedge{fill:#f4b183;stroke:#8a3b12}.wheel{fill:none;stroke:#555}.coil{fill:none;stroke:#1b6e53;\
              stroke-width:1.5}.dimension{stroke:#0b3d91}.pointer{stroke:#999}.dot{fill:#b00020}\
              .rail{stroke:#555;stroke-width:3}.axis{stroke:#bbb;stroke-dasharray:8 3 2 \
              3}text{fill:#111}</style>\n\
              <rect width=\"1180\" height=\"1330\" fill=\"#fff\"/>\n"
                .to_owned(),
    };
    let car = builtin::case_with("car_tangent_loaded", &[]).unwrap().parameters;
    let [truck, _] = &car.trucks;
    side(&mut sheet, truck);
    plan(&mut sheet, truck);
    whole(&mut sheet, &car);
    sheet.svg + "</svg>\n"
}

/// A truck from its left side.
fn side(sheet: &mut Sheet, own: &Truck) {
    let at = &own.geometry;
    let inch = |value: f64| value / INCH;
    let view = View {
        origin: [590.0, 400.0],
        scale: 7.6,
    };
    sheet.text(
        [20.0, 24.0],
        "start",
        "A truck from its left side, in the nominal layout (the loaded one)",
    );
    let (axle, high) = (inch(at.axle()), inch(at.axle_height));
    let wedge = &own.wedges[0];
    let (tall, long) = (inch(wedge.height), inch(wedge.height * wedge.angle.tan()));
    let [place, height] = [inch(at.wedge_distance), inch(at.wedge_height)];
    let (column, bottom) = (place + long / 3.0, height - tall / 3.0);
    let (adapter, seat) = (inch(at.adapter_height), inch(at.seat_height));
    sheet.line(&view, [[-58.0, 0.0], [58.0, 0.0]], "rail");
    sheet.line(&view, [[0.0, -2.0], [0.0, 34.0]], "axis");
    for end in [1.0, -1.0] {
        sheet.circle(&view, [end * axle, high], high, "wheel");
        // From the pedestal over the column to the middle, and back below.
        let outline = [
            [axle + 5.0, adapter],
            [axle + 5.0, adapter + 5.0],
            [axle - 7.0, adapter + 7.0],
            [0.0, adapter + 9.0],
            [0.0, adapter + 6.0],
            [column, adapter + 5.5],
            [column, bottom - 5.5],
            [0.0, bottom - 5.5],
            [0.0, bottom - 9.0],
            [column + 3.0, bottom - 9.0],
            [axle - 7.0, adapter - 1.0],
            [axle - 5.0, adapter],
        ];
        sheet.shape(&view, &outline.map(|[x, y]| [end * x, y]), "frame");
        sheet.block(
            &view,
            [[end * axle - 3.0, adapter - 1.5], [end * axle + 3.0, adapter]],
            "body",
        );
        let prism = [[column, bottom], [column - long, bottom], [column, bottom + tall]];
        sheet.shape(&view, &prism.map(|[x, y]| [end * x, y]), "wedge");
        sheet.coil(&view, [end * place, bottom - 5.5, bottom], 1.2);
        sheet.circle(&view, [end * place, height], 0.5, "dot");
    }
    let top = bottom + tall;
    let pocket = [
        [column - long - 0.2, bottom],
        [column - 0.6, top],
        [column - 0.6, adapter + 4.0],
        [0.0, adapter + 4.0],
        [0.0, bottom],
    ];
    for end in [1.0, -1.0] {
        sheet.shape(&view, &pocket.map(|[x, y]| [end * x, y]), "body");
    }
    let [half, _] = own.load_coils[0][0].place.map(inch);
    for x in [half, -half] {
        sheet.coil(&view, [x, bottom - 5.5, bottom], 1.6);
    }
    let plate = own
        .car_body
        .as_ref()
        .map_or(0.0, |car| inch(car.center_plate.height));
    sheet.block(&view, [[-7.0, plate - 0.8], [7.0, plate]], "body");
    sheet.across(&view, [-axle, axle], 43.0, "truck.wheelbase");
    sheet.across(&view, [-column, column], 39.0, "side_frame.column_distance");
    sheet.across(&view, [0.0, place], 36.0, "wedge.distance");
    sheet.across(&view, [-half, half], 4.0, "");
    sheet.pointer(
        &view,
        [half, 4.0],
        [26.0, 3.0],
        ("start", "load_springs.half_length, to each side"),
    );
    sheet.up(&view, [0.0, high], -56.0, ("start", "axle_height"));
    sheet.up(&view, [0.0, adapter], -48.5, ("start", ""));
    sheet.pointer(&view, [-48.5, adapter], [-51.0, 26.0], ("end", "adapter.height"));
    sheet.up(&view, [0.0, plate], 54.0, ("end", "center_plate.height"));
    sheet.pointer(
        &view,
        [0.0, seat],
        [-18.0, 3.0],
        (
            "end",
            "load_springs.seat_height: where coils hold \
    sideways",
        ),
    );
    let gib = inch(at.gib_height);
    sheet.pointer(&view, [0.0, gib], [-20.0, 32.0], ("end", "gib.height"));
    sheet.pointer(
        &view,
        [place, height],
        [24.0, 10.0],
        ("start", "wedge.center_height"),
    );
    let [_, up] = at.lands.map(inch);
    let land = inch(at.land_height);
    sheet.pointer(
        &view,
        [column, land + up],
        [21.0, 34.5],
        (
            "start",
            "lands.height, half_height: stops \
    at their middle and up and down",
        ),
    );
    sheet.pointer(
        &view,
        [-column, bottom + 0.5 * tall],
        [-22.0, 8.0],
        (
            "end",
            "side_frame.toe, \
    friction.column",
        ),
    );
    sheet.pointer(
        &view,
        [-place + 0.3, bottom + 0.55 * tall],
        [-21.0, 29.0],
        (
            "end",
            "wedge.angle, \
    friction.slope",
        ),
    );
    sheet.pointer(
        &view,
        [place, bottom - 3.0],
        [22.0, 7.0],
        (
            "start",
            "control_coil (on the side \
    frame, or in the pocket)",
        ),
    );
}

/// A truck from above.
fn plan(sheet: &mut Sheet, own: &Truck) {
    let at = &own.geometry;
    let inch = |value: f64| value / INCH;
    let view = View {
        origin: [500.0, 745.0],
        scale: 5.6,
    };
    sheet.text(
        [20.0, 445.0],
        "start",
        "The same truck from above: forward to the right, left up",
    );
    let (axle, nest, journal) = (inch(at.axle()), inch(at.nest()), inch(at.journal()));
    let wedge = &own.wedges[0];
    let (long, wide) = (inch(wedge.height * wedge.angle.tan()), inch(wedge.width));
    let place = inch(at.wedge_distance);
    sheet.line(&view, [[-48.0, 0.0], [48.0, 0.0]], "axis");
    sheet.line(&view, [[0.0, -46.0], [0.0, 46.0]], "axis");
    for end in [1.0, -1.0] {
        sheet.block(
            &view,
            [
                [end * axle - 1.5, -journal - 5.0],
                [end * axle + 1.5, journal + 5.0],
            ],
            "body",
        );
        for way in [1.0, -1.0] {
            let y = way * 29.75;
            sheet.block(
                &view,
                [[end * axle - 18.0, y - 2.75], [end * axle + 18.0, y + 2.75]],
                "wheel",
            );
        }
    }
    for way in [1.0, -1.0] {
        sheet.block(
            &view,
            [[-axle - 5.0, way * nest - 4.0], [axle + 5.0, way * nest + 4.0]],
            "frame",
        );
    }
    sheet.block(&view, [[-7.0, -nest - 5.0], [7.0, nest + 5.0]], "body");
    for way in [1.0, -1.0] {
        for end in [1.0, -1.0] {
            let x = end * (place + long / 3.0);
            sheet.block(
                &view,
                [
                    [x, way * nest - 0.5 * wide],
                    [x - end * long, way * nest + 0.5 * wide],
                ],
                "wedge",
            );
        }
        for coil in &own.load_coils[0] {
            let [x, y] = coil.place.map(inch);
            sheet.circle(&view, [x, way * nest + y], 2.2, "coil");
        }
    }
    let body = own.car_body.as_ref();
    let bearing = body.map_or(0.0, |car| inch(car.side_bearings.distance));
    let radius = body.map_or(0.0, |car| inch(car.center_plate.rings[0]));
    sheet.circle(&view, [0.0, 0.0], radius, "wheel");
    for way in [1.0, -1.0] {
        sheet.block(
            &view,
            [[-2.5, way * bearing - 2.5], [2.5, way * bearing + 2.5]],
            "body",
        );
    }
    let [points, stops] = at.adapter.map(inch);
    for y in [journal + points, journal - points] {
        sheet.circle(&view, [-axle, y], 0.6, "dot");
    }
    sheet.up(&view, [-nest, nest], -62.0, ("start", "truck.nest_distance"));
    sheet.up(
        &view,
        [-journal, journal],
        62.0,
        ("start", "truck.journal_distance"),
    );
    sheet.pointer(
        &view,
        [0.0, bearing],
        [14.0, 17.0],
        ("start", "side_bearing.distance"),
    );
    sheet.pointer(
        &view,
        [radius, 0.0],
        [14.0, -6.0],
        ("start", "center_plate.diameter"),
    );
    let [x, y] = own.load_coils[0][3].place.map(inch);
    sheet.pointer(
        &view,
        [x, -nest + y],
        [-20.0, -49.0],
        (
            "end",
            "load_springs.half_length, half_width: \
    groups; pitch: single coils",
        ),
    );
    sheet.pointer(
        &view,
        [place, -nest - 0.5 * wide],
        [18.0, -49.0],
        ("start", "wedge.width"),
    );
    let [aside, _] = at.lands.map(inch);
    sheet.pointer(
        &view,
        [place + long / 3.0, nest + aside],
        [18.0, 50.0],
        ("start", "lands.half_width"),
    );
    sheet.pointer(
        &view,
        [-axle, journal + points],
        [-44.0, 51.0],
        ("end", "adapter.point_distance"),
    );
    sheet.pointer(
        &view,
        [-axle, journal - stops],
        [-58.0, 34.0],
        ("end", "adapter.stop_distance"),
    );
}

/// A car from its left side.
fn whole(sheet: &mut Sheet, car: &Car) {
    let inch = |value: f64| value / INCH;
    let [own, _] = &car.trucks;
    let (height, distance) = (car.couplers.height, car.couplers.distance);
    let (axle, high) = (inch(own.geometry.axle()), inch(own.geometry.axle_height));
    let plate = own
        .car_body
        .as_ref()
        .map_or(0.0, |car| inch(car.center_plate.height));
    let view = View {
        origin: [590.0, 1250.0],
        scale: 1.6,
    };
    sheet.text([20.0, 1075.0], "start", "A car from its left side");
    let half = 0.5 * inch(car.truck_distance);
    let end = 0.5 * inch(distance);
    sheet.line(&view, [[-350.0, 0.0], [350.0, 0.0]], "rail");
    sheet.block(&view, [[-end + 12.0, 42.0], [end - 12.0, 92.0]], "body");
    for x in [half, -half] {
        for wheel in [axle, -axle] {
            sheet.circle(&view, [x + wheel, high], high, "wheel");
        }
        sheet.block(&view, [[x - axle - 5.0, 16.0], [x + axle + 5.0, 24.0]], "frame");
        sheet.block(&view, [[x - 8.0, 22.0], [x + 8.0, plate]], "body");
        sheet.circle(&view, [x, plate], 2.0, "dot");
    }
    let coupler = inch(height);
    for way in [1.0, -1.0] {
        sheet.block(
            &view,
            [[way * (end - 12.0), coupler - 3.0], [way * end, coupler + 3.0]],
            "body",
        );
    }
    let center = inch(car.body.height);
    sheet.circle(&view, [0.0, center], 3.0, "dot");
    sheet.up(
        &view,
        [0.0, center],
        0.0,
        ("start", "car.height (without lading); lading.masses: place"),
    );
    sheet.across(&view, [-half, half], 100.0, "car.truck_distance");
    sheet.across(&view, [-end, end], -14.0, "car.coupler_distance");
    sheet.up(&view, [0.0, coupler], end + 8.0, ("start", ""));
    let [x, y] = view.at([end + 8.0, coupler]);
    sheet.text([x - 4.0, y - 8.0], "middle", "car.coupler_height");
    sheet.pointer(
        &view,
        [half, plate],
        [half - 60.0, 8.0],
        ("end", "car.accelerometer_height"),
    );
}
