//! Trucks, cars, vehicles, tracks and profiles of wheels and rails.

use report::track_files::Survey;
use study::car::{self, CarCase};
use study::track::TrackFile;
use study::truck::{TruckCase, builtin};
use study::vehicle::{self, VehicleCase};
use wheelrail::profile::{Points, Profile, ProfileKind, SlicedProfile};
use wheelrail::track::Track;

use super::cases::{messages, refused};
use super::{ReadOutcome, Reader, in_file, nowhere, refused_as_written};

/// Cases of trucks.
pub const TRUCKS: Reader = Reader {
    name: "trucks",
    about: "case files of three-piece trucks",
    corpus: truck_corpus,
    dictionary: &[
        b"model = \"truck\"",
        b"[wedge.leading_left]",
        b"[wedge.trailing_right.friction]",
        b"[left_side_frame]",
        b"[trailing_wheelset]",
        b"[load]",
        b"kind = \"car_body\"",
        b"kind = \"thesis\"",
        b"kind = \"constant_contact\"",
        b"nest = \"single_coils\"",
        b"missing_left = [\"outer_leading_left\"]",
        b"free_coordinates = [\"z\", \"roll\"]",
        b"free_coordinates = []",
        b"truck.condition = \"worn\"",
        b"start.settle = \"1 s\"",
        b"lbf in s^2",
        b"lbf/in",
        b"deg",
    ],
    read: truck,
};

/// Track files.
pub const TRACKS: Reader = Reader {
    name: "tracks",
    about: "track files",
    corpus: track_corpus,
    dictionary: &[
        b"[[segments]]",
        b"[[irregularities]]",
        b"[[grades]]",
        b"tangent = \"100 ft\"",
        b"spiral = \"100 ft\"",
        b"curve = \"100 ft\"",
        b"degree = \"10 deg\"",
        b"radius = \"573 ft\"",
        b"superelevation = \"4 in\"",
        b"shape = \"joints\"",
        b"shape = \"jog\"",
        b"spectrum = \"fra_vertical\"",
        b"class = 6",
        b"rails = \"against\"",
        b"[columns]",
        b"milepost = { name = \"Milepost\" }",
        b"direction = \"falling\"",
        b"sides = \"running\"",
        b"station_equations = [{ back = \"MP 7\", ahead = \"MP 8 + 3 ft\" }]",
        b"form = \"bloss\"",
        b"band = \"D1\"",
    ],
    read: track,
};

/// Tables of measured track.
pub const MEASURED_TRACKS: Reader = Reader {
    name: "measured_tracks",
    about: "tables of measured track: irregularities, center lines",
    corpus: measured_corpus,
    dictionary: &[
        b"distance [ft]",
        b"left_profile [in]",
        b"right_alignment_in",
        b"cross_level [mm]",
        b"gauge [in]",
        b"degree_of_curve",
        b"curvature [1/ft]",
        b"grade [%]",
        b"_offset_62_ft_in",
        b"right_high",
        b"wide",
        b"MP 101 + 3 ft",
    ],
    read: measured,
};

/// Alignments of LandXML.
pub const ALIGNMENTS: Reader = Reader {
    name: "alignments",
    about: "alignments and cant of LandXML",
    corpus: alignment_corpus,
    dictionary: &[
        b"<Line length=\"9\"/>",
        b"<Curve radius=\"99\" length=\"9\" rot=\"cw\"/>",
        b"<Spiral length=\"9\" radiusStart=\"INF\" radiusEnd=\"99\" rot=\"cw\" spiType=\"cubicParabola\"/>",
        b"<CantStation station=\"1\" appliedCant=\"9\" adverse=\"true\"/>",
        b"<StaEquation/>",
        b"sinusoid",
        b"linearUnit=\"USSurveyFoot\"",
        b"<![CDATA[",
        b"&#0;",
    ],
    read: alignment,
};

/// Points of profiles.
pub const PROFILES: Reader = Reader {
    name: "profiles",
    about: "points of wheel and rail profiles: CSV, Simpack, MiniProf, VAMPIRE; lists of slices",
    corpus: profile_corpus,
    dictionary: &[
        b"y [mm],z [mm]",
        b"field side positive",
        b"header.begin",
        b"point.begin",
        b"point.end",
        b"units.len",
        b"y_from_back [mm]",
        b"ProgramName=MiniProf",
        b"ColumnDef=X,Y",
        b"XOffset=",
        b"DiameterTaperline=",
        b"WHEELPROFILE",
        b"TREADDATUM US1",
        b"GAUGEPOINT CUSTOM 14",
        b"FLANGEBACK 1360",
        b"0 1000\n2\n0 0\n1\n",
        b"'a.prr'",
        b"-1e308",
        b"nan",
    ],
    read: profile,
};

fn truck_corpus() -> Vec<Vec<u8>> {
    let some = [
        "truck_vertical_constant_toe_out",
        "truck_warp_nest_variable_rising",
        "truck_drop_variable_empty",
        "truck_adapter_stops_constant",
    ];
    let mut corpus: Vec<Vec<u8>> = some
        .iter()
        .filter_map(|name| builtin::text(name).ok())
        .map(|text| text.as_bytes().to_vec())
        .collect();
    corpus.push(
        b"model = \"truck\"\n[load]\nkind = \"car_body\"\n[wedge.leading_left]\ntoe = \"0.2 deg in\"\n\
          [control_coil]\nkind = \"thesis\"\n[load_springs]\nnest = \"single_coils\"\n\
          missing_right = [\"outer_leading_left\"]\n[adapter]\nkind = \"pad\"\n"
            .to_vec(),
    );
    corpus
}

fn truck(input: &[u8]) -> ReadOutcome {
    let Ok(text) = std::str::from_utf8(input) else {
        return ReadOutcome::NO_TEXT;
    };
    match TruckCase::parse("truck.toml", text, nowhere(), &[]) {
        Ok(case) => {
            match TruckCase::parse("again.toml", case.to_toml(), nowhere(), &[]) {
                Ok(again) => assert!(again == case, "another case: {}", case.name),
                Err(error) => refused_as_written(&messages(&error)),
            }
            ReadOutcome::ACCEPTED
        }
        Err(error) => refused(&error),
    }
}

/// Cases of cars.
pub const CARS: Reader = Reader {
    name: "cars",
    about: "case files of freight cars on track",
    corpus: car_corpus,
    dictionary: &[
        b"model = \"car\"",
        b"[front_truck.friction]",
        b"[rear_truck]",
        b"[[lading.masses]]",
        b"kind = \"masses\"",
        b"[[track.segments]]",
        b"file = \"track.toml\"",
        b"geometry = \"linear\"",
        b"profile = \"cone_1:20\"",
        b"over_distance = [[\"0 ft\", \"60 mph\"]]",
        b"kind = \"coasting\"",
        b"[wheels.axle_1.left]",
        b"flats = [{ length = \"50 mm\", angle = \"90 deg\" }]",
        b"out_of_round = [{ order = 3, amplitude = \"0.1 mm\" }]",
        b"[damage]",
    ],
    read: car,
};

fn car_corpus() -> Vec<Vec<u8>> {
    let some = ["car_spiral_loaded", "car_hunting_empty"];
    let mut corpus: Vec<Vec<u8>> = some
        .iter()
        .filter_map(|name| car::builtin::text(name).ok())
        .map(|text| text.as_bytes().to_vec())
        .collect();
    corpus.push(
        b"model = \"car\"\n[lading]\nkind = \"masses\"\n[[lading.masses]]\nname = \"coil\"\n\
          weight = \"40 kip\"\nplace = [\"0 in\", \"5 in\", \"70 in\"]\n\
          inertia = [\"0 lbf in s^2\", \"1 lbf in s^2\", \"1 lbf in s^2\"]\n[front_truck.wedge]\n\
          kind = \"massless\"\n[wheels]\nprofile = \"cone_1:20\"\ncreep = \"fastsim\"\n[speed]\n\
          kind = \"coasting\"\nvalue = \"0 mph\"\n[track]\nsupport = { kind = \"rigid\" }\n\
          segments = [{ tangent = \"3000 ft\" }]\n"
            .to_vec(),
    );
    corpus
}

/// Cases of vehicles of bodies and elements.
pub const VEHICLES: Reader = Reader {
    name: "vehicles",
    about: "case files of vehicles of bodies and elements",
    corpus: vehicle_corpus,
    dictionary: &[
        b"model = \"vehicle\"",
        b"[bodies.frame]",
        b"[elements.spring]",
        b"[wheelsets.leading]",
        b"[trucks.front]",
        b"like = \"frame\"",
        b"kind = \"bushing\"",
        b"kind = \"wedge\"",
        b"a = \"frame\"",
        b"b = \"ground\"",
        b"at = [\"0 in\", \"0 in\", \"20 in\"]",
        b"free_coordinates = []",
    ],
    read: vehicle,
};

fn vehicle_corpus() -> Vec<Vec<u8>> {
    let names = ["vehicle_catalog", "vehicle_two_axles", "vehicle_two_masses"];
    let texts = names.iter().filter_map(|name| vehicle::builtin::text(name).ok());
    texts.map(|text| text.as_bytes().to_vec()).collect()
}

fn vehicle(input: &[u8]) -> ReadOutcome {
    let Ok(text) = std::str::from_utf8(input) else {
        return ReadOutcome::NO_TEXT;
    };
    match VehicleCase::parse("vehicle.toml", text, nowhere(), &[]) {
        Ok(case) => {
            match VehicleCase::parse("again.toml", case.to_toml(), nowhere(), &[]) {
                Ok(again) => assert!(again == case, "another case: {}", case.name),
                Err(error) => refused_as_written(&messages(&error)),
            }
            ReadOutcome::ACCEPTED
        }
        Err(error) => refused(&error),
    }
}

fn car(input: &[u8]) -> ReadOutcome {
    let Ok(text) = std::str::from_utf8(input) else {
        return ReadOutcome::NO_TEXT;
    };
    match CarCase::parse("car.toml", text, nowhere(), &[]) {
        Ok(case) => {
            match CarCase::parse("again.toml", case.to_toml(), nowhere(), &[]) {
                Ok(again) => assert!(again == case, "another case: {}", case.name),
                Err(error) => refused_as_written(&messages(&error)),
            }
            ReadOutcome::ACCEPTED
        }
        Err(error) => refused(&error),
    }
}

fn track_corpus() -> Vec<Vec<u8>> {
    vec![
        b"[[segments]]\ntangent = \"500 ft\"\n[[segments]]\nspiral = \"200 ft\"\n[[segments]]\n\
          curve = \"600 ft\"\ndegree = \"10 deg\"\ndirection = \"right\"\nsuperelevation = \"4 in\"\n\
          [[irregularities]]\nshape = \"joints\"\nrails = \"left\"\ndirection = \"vertical\"\n\
          depth = \"0.75 in\"\nstart = \"519.5 ft\"\n"
            .to_vec(),
        b"name = \"flat\"\n[[segments]]\ntangent = \"100 m\"\n[[grades]]\ndistance = \"0 m\"\n\
          grade = 0.01\n[[irregularities]]\nspectrum = \"fra_lateral\"\nclass = 6\n\
          direction = \"lateral\"\nterms = 70\nseed = 3\n"
            .to_vec(),
    ]
}

fn track(input: &[u8]) -> ReadOutcome {
    let Ok(text) = std::str::from_utf8(input) else {
        return ReadOutcome::NO_TEXT;
    };
    match TrackFile::parse("track.toml", text) {
        Ok(file) => {
            for share in [0.0, 0.5, 1.0] {
                let distance = share * file.track.center_line.length();
                let station = file.track.center_line.at(distance);
                assert!(
                    station.position.iter().all(|own| own.is_finite()),
                    "no place at {distance} m"
                );
                let rails = file.track.rails(distance);
                let finite = rails
                    .iter()
                    .all(|rail| rail.lateral[0].is_finite() && rail.vertical[0].is_finite());
                assert!(finite, "no rails at {distance} m");
            }
            ReadOutcome::ACCEPTED
        }
        Err(error) => refused(&error),
    }
}

fn measured_corpus() -> Vec<Vec<u8>> {
    let mut rails =
        "distance [ft],left_profile [in],right_profile_offset_62_ft_in,gauge [in]\n,down,up,wide\n"
            .to_owned();
    let mut line = "distance_ft;degree_of_curve;superelevation_in;grade\n".to_owned();
    for k in 0..80 {
        rails += &format!("{k},0.{k},-0.1,56.{k}\n");
        line += &format!("{};{k};0.1;0.01\n", 10 * k);
    }
    // As a measuring car of North America writes it, toward falling mileposts.
    let mut car = "MP,Foot,Gage,Left Prof 62\n".to_owned();
    for k in (0..80).rev() {
        car += &format!("{},{},56.5,0.{k}\n", 100 + k / 40, 5240 * (k / 40) + k % 40);
    }
    vec![rails.into_bytes(), line.into_bytes(), car.into_bytes()]
}

fn alignment_corpus() -> Vec<Vec<u8>> {
    vec![
        b"<LandXML><Units><Metric linearUnit=\"meter\"/></Units><Alignments><Alignment name=\"A\" \
          staStart=\"10\"><CoordGeom><Line><Start>0 0</Start><End>0 30</End></Line>\
          <Spiral length=\"40\" radiusStart=\"INF\" radiusEnd=\"300\" rot=\"ccw\" spiType=\"bloss\"/>\
          <Curve radius=\"300\" length=\"50\" rot=\"ccw\"><End>9 99</End></Curve></CoordGeom>\
          <Cant><CantStation station=\"40\" appliedCant=\"0\"/>\
          <CantStation station=\"80\" appliedCant=\"90\"/></Cant></Alignment></Alignments></LandXML>"
            .to_vec(),
    ]
}

fn alignment(input: &[u8]) -> ReadOutcome {
    in_file("line.xml", input, |xml| {
        let file = xml.with_file_name("track.toml");
        let text = "[center_line]\ntable = \"line.xml\"\ncant_unit = \"mm\"\n";
        if std::fs::write(&file, text).is_err() {
            return ReadOutcome::NO_TEXT;
        }
        match TrackFile::read(&file) {
            Ok(file) => shown(&file.track),
            Err(error) => refused(&error),
        }
    })
}

/// Track files that take a table beside them, of which each table is one or the other.
const WITH_TABLES: [&str; 5] = [
    "segments = [{ tangent = \"30 ft\" }]\n[[irregularities]]\ntable = \"table.csv\"\n\
     form = \"space_curve\"\ntaper = \"10 ft\"\nbeyond = \"level\"\n",
    "segments = [{ tangent = \"30 ft\" }]\n[[irregularities]]\ntable = \"table.csv\"\n\
     form = \"space_curve\"\nsigns = \"usual\"\nstart = \"3 ft\"\ntaper = \"3 ft\"\n",
    "segments = [{ tangent = \"100 ft\" }]\n[[irregularities]]\ntable = \"table.csv\"\nform = \"mid_chord\"\n\
     chord = \"62 ft\"\nshortest = \"36 ft\"\nlongest = \"70 ft\"\ntaper = \"10 ft\"\nbeyond = \"level\"\n",
    "[center_line]\ntable = \"table.csv\"\nsigns = \"usual\"\n",
    "direction = \"falling\"\nsegments = [{ tangent = \"30 ft\" }]\n\
     station_equations = [{ back = \"MP 100 + 40 ft\", ahead = \"MP 101 + 5240 ft\" }]\n\
     [columns]\nmilepost = { name = \"MP\" }\nmilepost_offset = { name = \"Foot\", unit = \"ft\" }\n\
     left_profile = { name = \"Left Prof 62\", unit = \"in\", sign = \"down\" }\n[[irregularities]]\n\
     table = \"table.csv\"\nform = \"space_curve\"\nband = \"D1\"\ntaper = \"3 ft\"\n\
     beyond = \"level\"\n",
];

fn measured(input: &[u8]) -> ReadOutcome {
    in_file("table.csv", input, |table| {
        let file = table.with_file_name("track.toml");
        let read = |text: &&str| {
            if std::fs::write(&file, text).is_err() {
                return ReadOutcome::NO_TEXT;
            }
            match TrackFile::read(&file) {
                Ok(file) => shown(&file.track),
                Err(error) => refused(&error),
            }
        };
        WITH_TABLES
            .iter()
            .map(read)
            .fold(ReadOutcome::NO_TEXT, ReadOutcome::or)
    })
}

/// What `wedgelab track show` shows of a track has numbers.
fn shown(track: &Track) -> ReadOutcome {
    let interval = (track.center_line.length() / 20.0).max(1e-3);
    let mut table = Vec::new();
    assert!(
        Survey::new(track, interval).write(&mut table).is_ok(),
        "no table: of a track"
    );
    let text = String::from_utf8_lossy(&table);
    let none = ["NaN", "nan", "inf"].into_iter().find(|word| text.contains(word));
    assert!(none.is_none(), "not finite: {none:?} in the table of a track");
    ReadOutcome::ACCEPTED
}

fn profile_corpus() -> Vec<Vec<u8>> {
    // A rail's head as an arc, and a file of Simpack.
    let mut csv = "# field side positive\ny [mm],z [mm]\n".to_owned();
    for i in -30..=30 {
        let y = f64::from(i);
        csv += &format!("{y},{}\n", (300.0 * 300.0 - y * y).sqrt() - 300.0);
    }
    // The same head as MiniProf and VAMPIRE have it, and a list of slices.
    let rows: Vec<(i32, f64)> = (-30..=30)
        .map(|i| (i, (300.0 * 300.0 - f64::from(i * i)).sqrt() - 300.0))
        .collect();
    let mut mini = "ProgramName=MiniProf for Windows\nColumnDef=X,Y\nXOffset=0\n\n".to_owned();
    let mut vampire = "RAILPROFILE\na title\nGAUGEPOINT US\nGAUGE 1435.1\n".to_owned();
    for (y, z) in rows {
        mini += &format!("{y} {z}\n");
        vampire += &format!("{} {z} {} {z}\n", -750 - y, 750 + y);
    }
    let list = "% slices\n0 1000\n2\n0 0 0\n1\n0.0 'a.prr'\n1.0 'b.prr'\n";
    vec![
        csv.into_bytes(),
        include_bytes!("../../../crates/wheelrail/tests/data/manchester/MBench_UIC60_v3.prr").to_vec(),
        mini.into_bytes(),
        vampire.into_bytes(),
        list.into(),
    ]
}

fn profile(input: &[u8]) -> ReadOutcome {
    let Ok(text) = std::str::from_utf8(input) else {
        return ReadOutcome::NO_TEXT;
    };
    let read = |points: Result<Points, wheelrail::profile::ProfileError>| {
        let made = points.and_then(|points| {
            let rail = Profile::of_points(&points, ProfileKind::Rail, 2e-5);
            rail.or_else(|_| Profile::of_points(&points, ProfileKind::Wheel, 2e-5))
        });
        match made {
            Ok(profile) => {
                let [y, z] = profile.top();
                assert!(y.is_finite() && z.is_finite(), "no top");
                ReadOutcome::ACCEPTED
            }
            Err(error) => ReadOutcome::refused_with(&format!("{error}; {}", error.remedy())),
        }
    };
    let slices = match SlicedProfile::list("rails.slcs", text, ProfileKind::Rail) {
        Ok((slices, _)) => {
            let grow = slices.windows(2).all(|pair| pair[0].place < pair[1].place);
            assert!(grow, "places of slices that do not grow");
            ReadOutcome::ACCEPTED
        }
        Err(error) => ReadOutcome::refused_with(&format!("{error}; {}", error.remedy())),
    };
    read(Points::from_csv("profile.csv", text))
        .or(read(Points::from_simpack("profile.prr", text)))
        .or(read(Points::from_miniprof("profile.whl", text, None)))
        .or(read(Points::from_vampire("profile.rai", text, None)))
        .or(slices)
}
