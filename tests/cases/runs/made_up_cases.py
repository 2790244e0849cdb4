"""Cases with as many blocks of the summary as a run can have, on films of the atlas: a tenth of a second each."""

from __future__ import annotations

from .changed_cases import changed

FORCE, MOMENT = [1500.0, 900.0, 500.0], [1200.0, -2000.0]
STEEL = {
    "youngs_modulus_GPa": 208.0,
    "poisson_ratio": 0.3,
    "density_kg_m3": 7800.0,
    "thermal_expansion_um_m_K": 12.0,
    "thermal_conductivity_W_m_K": 21.0,
    "specific_heat_J_kg_K": 480.0,
    "kind": "bearing steel",
}
ANGULAR = {
    "title": "angular contact bearing under force and moment",
    "bearing": {
        "name": "made up",
        "type": "angular contact",
        "ball_diameter_mm": 12.0,
        "pitch_diameter_mm": 60.0,
        "balls": 7,
        "inner_groove_radius_mm": 6.24,
        "outer_groove_radius_mm": 6.30,
        "free_contact_angle_deg": 24.0,
        "ring_material": "steel",
        "ball_material": "steel",
        "first_ball_azimuth_deg": 13.0,
        "bore_mm": 40.0,
        "outside_diameter_mm": 80.0,
        "width_mm": 18.0,
        "inner_shoulder_diameter_mm": 52.6,
        "outer_shoulder_diameter_mm": 67.4,
    },
    "materials": {"steel": STEEL},
    "lubricant": {
        "viscosity_mPa_s": 30.0,
        "pressure_viscosity_1_GPa": 20.0,
        "density_kg_m3": 870.0,
        "viscosity_law": "barus",
        "density_law": "incompressible",
        "thermal_conductivity_W_m_K": 0.14,
        "specific_heat_J_kg_K": 2000.0,
        "viscosity_temperature_1_K": 0.04,
        "thermal_expansion_1_K": 7e-4,
        "rheology": "ree-eyring",
        "eyring_stress_MPa": 6.0,
        "limiting_stress_coefficient": 0.06,
        "flooded_layer_um": 120.0,
        "contamination_factor": 0.6,
    },
    "operation": {"inner_speed_rpm": 3000.0, "force_N": FORCE, "moment_N_mm": MOMENT, "temperature_C": 60.0},
    "surface": {"inner_ring_roughness_um": 0.09, "outer_ring_roughness_um": 0.11, "ball_roughness_um": 0.04},
    "cage": {"pocket_friction": 0.07, "pocket_clearance_mm": 0.3},
    "friction": {"coefficient": 0.08, "models": "all", "lubrication": "oil bath"},
    "ehl": {"films": "atlas", "film_maps": "none"},
}
DEEP_GROOVE = {
    "bearing.type": "deep groove",
    "bearing.free_contact_angle_deg": None,
    "bearing.diametral_clearance_um": 14.0,
    "bearing.inner_groove_radius_mm": 6.17,
    "bearing.outer_groove_radius_mm": 6.29,
    "operation.force_N": [200.0, 3000.0, 400.0],
    "operation.moment_N_mm": None,
}
SUPPLIED = {  # little oil, and a cage that a land guides
    "friction.lubrication": "oil air",
    "friction.supply_mL_min": 0.8,
    "friction.supply_track_share": 0.4,
    "friction.supply_loss": 0.07,
    "friction.supply_residence_s": 15.0,
    "friction.supply_decay_s": 600.0,
    "cage.guided_by": "outer ring",
    "cage.land_diameter_mm": 67.0,
    "cage.land_width_mm": 6.0,
    "cage.land_clearance_um": 200.0,
}
HEATED = {
    "operation.temperature": "self-heated",
    "lubricant": {"name": "iso vg 68", "contamination_factor": 0.6},
    "friction.heat_transfer_W_K": 1.2,
    "friction.ambient_C": 25.0,
    "friction.oil_level_mm": 4.0,
}
FITTED = {
    "fit.inner_ring_interference_um": 14.0,
    "fit.outer_ring_interference_um": 6.0,
    "fit.housing_outside_diameter_mm": 120.0,
    "fit.shaft_bore_mm": 12.0,
    "temperatures.inner_ring_C": 65.0,
    "temperatures.outer_ring_C": 55.0,
    "temperatures.ball_C": 70.0,
    "bearing.diametral_clearance_um": 40.0,
}
PAIR = {
    "rows": [
        {"axial_position_mm": -9.0, "loaded_by": "+x", "preload_N": 700.0},
        {"axial_position_mm": 9.0, "loaded_by": "-x", "preload_N": 700.0},
    ],
    "operation.force_N": [300.0, 900.0, 500.0],
}
CYCLE = {
    "load_cases": [
        {"share": 0.7},
        {"share": 0.2, "inner_speed_rpm": 1500.0, "outer_speed_rpm": -700.0},
        {"share": 0.1, "inner_speed_rpm": 0.0, "outer_speed_rpm": 2000.0, "temperature_C": 45.0},
    ]
}
CASES = {
    "angular contact": ANGULAR,
    "deep groove": changed(ANGULAR, DEEP_GROOVE),
    "supplied": changed(ANGULAR, DEEP_GROOVE | SUPPLIED),
    "heated": changed(ANGULAR, HEATED),
    "fitted": changed(ANGULAR, DEEP_GROOVE | FITTED),
    "pair": changed(ANGULAR, PAIR),
    "cycle": changed(ANGULAR, HEATED | CYCLE | {"operation.temperature": None}),
    "grease": changed(ANGULAR, {"friction.lubrication": "grease", "cage.pocket_friction": None}),
}
