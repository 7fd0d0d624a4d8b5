"""Machines: where their forces act, and what damage adds. One turn of the input shaft is 1.

Each class gives `kinematics` (a file for rvbench, or the name of one that it ships), `parts`
(kind of damage: component as rvbench names it), `record_turns` (what a record must hold), `race_turns` (of the
bearing's inner race against the outer one) and `forces`.
"""
from math import gcd

import numpy as np

from draws import TURN
from sources import Forces, Mesh, Modulation, Race, Shaft, Toothing, act, blows

SHAFT_DEPTH = 0.7   # of each planet's mesh, once per turn
TOOTH_BLOW = 8      # over the first harmonic of the mesh
TOOTH_WIDTH = 0.06 / TURN
PIN_BLOW = 10       # over the first harmonic of the pin pass
PIN_WIDTH = 0.07 / TURN


class Planets:
    """Planets between a sun and what they roll in, each with its phase, its gain and its path."""

    def __init__(self, draws, name, sun_teeth, count):
        self.name, self.sun_teeth, self.count = name, sun_teeth, count
        self.mesh = Mesh(draws, name, count, 0.2)
        self.modulation = Modulation(draws, name, count)
        self.share = draws.uniform(f"share of the path of {name} that turns", 0.1, 0.8)
        self.sun_phase = draws.phases(f"sun of {name}", 1)[0]
        self.bend_phase = draws.phases(f"bend of {name}", 1)[0]
        self.toothing = Toothing(draws, f"sun of {name}", sun_teeth)
        self.struck = draws.whole(f"struck planet of {name}", 0, count - 1)
        self.tooth_phase = draws.phases(f"struck tooth of {name}", 1)[0] / TURN
        self.is_gaussian = bool(draws.whole("kind of blow", 0, 1))

    def add(self, forces, sun, planet, carrier, size, most_harmonics, damages):
        """sun, planet: turns against the carrier; carrier: in the housing."""
        for k in range(self.count):
            where = k / self.count
            path = carrier + where
            passing = self.sun_teeth * (sun - where)
            clean = size * self.mesh.force(k, passing, most_harmonics)
            sound = clean * self.modulation.swing(k, sun - where, planet, self.sun_phase)
            if "sun" in damages:
                sound = sound * self.toothing.louder(damages["sun"])
                scatter = sound * self.toothing.scatter(passing, damages["sun"])
                self.act(forces.damage, scatter, path)
            self.act(forces.mesh, sound, path)
            if "shaft" in damages:
                bend = np.cos(TURN * (sun - where) + self.bend_phase)
                self.act(forces.damage, SHAFT_DEPTH * damages["shaft"] * clean * bend, path)
            if "tooth" in damages and k == self.struck:
                blow = TOOTH_BLOW * damages["tooth"] * size * self.mesh.amplitudes[0]
                train = blows(planet + self.tooth_phase, TOOTH_WIDTH, self.is_gaussian)
                self.act(forces.damage, blow * train, path)

    def act(self, forces, samples, path):
        act(forces, self.name, samples, path, self.share)


class RvReducer:
    """Sun, planets and cranks, two cycloid discs half a turn apart, carrier as output."""

    parts = {"shaft": "input_shaft", "sun": "sun_gear", "tooth": "planet_gear", "pin": "pin_housing",
             "race": "bearing_inner"}

    def __init__(self, draws, planets, teeth=(9, 27, 40), race=(11, 5 / 26), kinematics="rv20e"):
        self.sun_teeth, self.planet_teeth, self.pins = teeth
        self.lobes = self.pins - 1
        numerator = self.sun_teeth + self.planet_teeth * self.pins
        self.i = numerator / self.sun_teeth
        self.race_turns = self.pins / self.i
        self.record_turns = 4.1 * numerator / gcd(numerator, self.sun_teeth)
        self.kinematics = kinematics
        self.planets = Planets(draws, "sun-planet mesh", self.sun_teeth, planets)
        self.pin_mesh = Mesh(draws, "pin pass", 2, 0.1)
        level = draws.level("pin pass over sun-planet mesh", 0.2, 2) * self.planets.mesh.rms / self.pin_mesh.rms
        self.pin_mesh.amplitudes *= level
        self.pin_modulation = Modulation(draws, "pin pass", 2)
        self.pin_path = draws.uniform("share of the pin force that turns with the crank", 0, 0.4)
        self.pin_phase = draws.phases("struck pin", 1)[0] / TURN
        self.shaft = Shaft(draws, "input shaft", self.planets.mesh.rms)
        self.race = Race(draws, "crank bearing", *race, is_inner=True)

    def forces(self, turns, speed_Hz, size, rate_Hz, point, damages):
        """damages: {kind: severity}. point: of the matrix, by its number."""
        i = self.i
        sun, planet, orbit, carrier = turns * (i - 1) / i, turns * self.race_turns, turns * self.lobes / i, turns / i
        forces = Forces()

        def fit(order):  # as many harmonics as the record's own rate can hold
            return int(0.49 * rate_Hz / (order * speed_Hz))
        self.planets.add(forces, sun, planet, carrier, size, fit(self.sun_teeth * (i - 1) / i), damages)
        for disc in range(2):
            turned = orbit + 0.5 * disc
            force = size * self.pin_mesh.force(disc, self.pins * turned, fit(self.pins * self.lobes / i))
            force = force * self.pin_modulation.swing(disc, turned, planet + 0.5 * disc)
            act(forces.mesh, "pin pass", force, turned, self.pin_path)
            if "pin" in damages:
                train = blows(turned + self.pin_phase, PIN_WIDTH, self.planets.is_gaussian)
                blow = PIN_BLOW * damages["pin"] * size * self.pin_mesh.amplitudes[0] * self.pin_mesh.gains[disc]
                act(forces.damage, "struck pin", blow * train)
        act(forces.rest, "input shaft", self.shaft.force(turns))
        if "shaft" in damages:
            act(forces.damage, "input shaft", self.shaft.force(turns, damages["shaft"]))
        if "race" in damages:
            act(forces.damage, self.planets.name, self.race.force(
                planet, size * self.planets.mesh.rms, damages["race"], rate_Hz, point), carrier, self.planets.share)
        return forces


class TwoStageTrain:
    """Two pairs of gears on three shafts, a bearing on the middle one."""

    parts = {"shaft": "input_shaft", "wheel": "first_wheel", "tooth": "second_pinion", "last": "second_wheel",
             "race": "bearing_outer"}

    def __init__(self, draws):
        self.teeth = [draws.whole(f"teeth {k}", low, high)
                      for k, (low, high) in enumerate(((17, 25), (41, 60), (19, 29), (47, 70)))]
        a, b, c, d = self.teeth
        self.race_turns, self.output = a / b, a * c / (b * d)
        self.meshes = [Mesh(draws, name, 1, 0.2) for name in ("first mesh", "second mesh")]
        level = draws.level("second mesh over first", 0.3, 3) * self.meshes[0].rms / self.meshes[1].rms
        self.meshes[1].amplitudes *= level
        self.modulations = [Modulation(draws, name, 1) for name in ("first mesh", "second mesh")]
        self.shaft = Shaft(draws, "input shaft", self.meshes[0].rms)
        self.record_turns = 10 / self.output
        self.bend_phase = draws.phases("bend", 1)[0]
        self.toothing = Toothing(draws, "first wheel", b)
        self.tooth_phase, self.last_phase = draws.phases("struck teeth", 2) / TURN
        self.is_gaussian = bool(draws.whole("kind of blow", 0, 1))
        balls, ratio = draws.whole("balls", 7, 13), draws.uniform("ball over pitch diameter", 0.15, 0.3)
        self.race = Race(draws, "middle bearing", balls, ratio, is_inner=False)
        self.kinematics = {
            "machine": "two-stage train", "source": "drawn",
            "shafts": [{"name": "input shaft", "component": "input_shaft"},
                       {"name": "middle shaft", "component": "middle_shaft"},
                       {"name": "output shaft", "component": "output_shaft"}],
            "meshes": [{"name": "first mesh", "driver": "input shaft", "driver_teeth": a,
                        "driver_component": "first_pinion", "driven": "middle shaft", "driven_teeth": b,
                        "driven_component": "first_wheel"},
                       {"name": "second mesh", "driver": "middle shaft", "driver_teeth": c,
                        "driver_component": "second_pinion", "driven": "output shaft", "driven_teeth": d,
                        "driven_component": "second_wheel"}],
            "bearings": [{"name": "middle bearing", "shaft": "middle shaft", "rolling_elements": balls,
                          "ball_diameter_mm": 40 * ratio, "pitch_diameter_mm": 40}]}

    def forces(self, turns, speed_Hz, size, rate_Hz, point, damages):
        middle, output = turns * self.race_turns, turns * self.output
        a, _, c, _ = self.teeth
        forces = Forces()
        stages = ((turns, middle, a * turns, a), (middle, output, c * middle, c * self.race_turns))
        for stage, (first, second, passing, order) in enumerate(stages):
            mesh = self.meshes[stage]
            clean = size * mesh.force(0, passing, int(0.49 * rate_Hz / (order * speed_Hz)))
            sound = clean * self.modulations[stage].swing(0, first, second)
            if stage == 0 and "wheel" in damages:
                sound = sound * self.toothing.louder(damages["wheel"])
                act(forces.damage, mesh.name, sound * self.toothing.scatter(passing, damages["wheel"]))
            act(forces.mesh, mesh.name, sound)
            if stage == 0 and "shaft" in damages:
                bend = np.cos(TURN * turns + self.bend_phase)
                act(forces.damage, mesh.name, SHAFT_DEPTH * damages["shaft"] * clean * bend)
            for kind, gear, phase in (("tooth", first, self.tooth_phase), ("last", second, self.last_phase)):
                if stage == 1 and kind in damages:
                    blow = TOOTH_BLOW * damages[kind] * size * mesh.amplitudes[0]
                    act(forces.damage, mesh.name, blow * blows(gear + phase, TOOTH_WIDTH, self.is_gaussian))
        act(forces.rest, "input shaft", self.shaft.force(turns))
        if "shaft" in damages:
            act(forces.damage, "input shaft", self.shaft.force(turns, damages["shaft"]))
        if "race" in damages:
            act(forces.damage, "middle bearing",
                self.race.force(middle, size * self.meshes[0].rms, damages["race"], rate_Hz, point))
        return forces


class PlanetaryStage:
    """A sun drives planets inside a fixed ring; the carrier is the output."""

    parts = {"shaft": "input_shaft", "sun": "sun_gear", "tooth": "planet_gear", "ring": "ring_gear",
             "race": "bearing_outer"}

    def __init__(self, draws):
        self.count = draws.whole("planets", 2, 4)
        # Planets stand evenly if the teeth of sun and ring add to a multiple of their number.
        sun = draws.whole("sun teeth", 13, 24)
        planet = draws.whole("planet teeth", 17, 30)
        while (2 * sun + 2 * planet) % self.count:
            planet += 1
        self.teeth = sun, planet, sun + 2 * planet
        self.i = 1 + self.teeth[2] / sun
        self.race_turns = (1 - 1 / self.i) * sun / planet
        self.planets = Planets(draws, "planet mesh", sun, self.count)
        self.shaft = Shaft(draws, "input shaft", self.planets.mesh.rms)
        self.ring_phase = draws.phases("struck ring", 1)[0] / TURN
        self.race = Race(draws, "planet bearing", draws.whole("balls", 7, 13),
                         draws.uniform("ball over pitch diameter", 0.15, 0.3), is_inner=False)
        self.record_turns = 10 * self.i
        self.kinematics = {
            "machine": "planetary stage", "source": "drawn",
            "planetary": {"sun_teeth": sun, "planet_teeth": planet, "ring_teeth": self.teeth[2],
                          "planets": self.count,
                          "planet_bearing": {
                              "rolling_elements": self.race.balls, "ball_diameter_mm": 40 * self.race.ratio,
                              "pitch_diameter_mm": 40, "fixed_race": "inner"}}}

    def forces(self, turns, speed_Hz, size, rate_Hz, point, damages):
        sun_teeth = self.teeth[0]
        carrier = turns / self.i
        sun = turns - carrier
        planet = turns * self.race_turns
        forces = Forces()
        order = sun_teeth * (1 - 1 / self.i)
        self.planets.add(forces, sun, planet, carrier, size, int(0.49 * rate_Hz / (order * speed_Hz)), damages)
        if "ring" in damages:
            for k in range(self.count):  # each planet strikes the same place of the ring
                train = blows(carrier + k / self.count + self.ring_phase, TOOTH_WIDTH / self.i,
                              self.planets.is_gaussian)
                blow = TOOTH_BLOW * damages["ring"] * size * self.planets.mesh.amplitudes[0]
                act(forces.damage, "struck ring", self.planets.mesh.gains[k] * blow * train)
        act(forces.rest, "input shaft", self.shaft.force(turns))
        if "shaft" in damages:
            act(forces.damage, "input shaft", self.shaft.force(turns, damages["shaft"]))
        if "race" in damages:
            blows_of_race = self.race.force(planet, size * self.planets.mesh.rms, damages["race"], rate_Hz, point)
            act(forces.damage, self.planets.name, blows_of_race, carrier, self.planets.share)
        return forces
