#!/usr/bin/python3
"""An office from photos to a lighting control table, cell by cell (open it in an editor that knows `# %%`).

    python3 example.py [SESSION [OUT]]

Packages: luxfit, numpy. The room is the one that the package installs.
"""

# %% The session: what is given
import sys

import numpy as np

import luxfit

session_path = sys.argv[1] if len(sys.argv) > 1 else "/usr/share/luxfit/office/session.toml"
out = sys.argv[2] if len(sys.argv) > 2 else "out"

session = luxfit.read_session(session_path)
print(f"{session.name}: {len(session.photos['file'])} photos, {len(session.tags)} tags, "
      f"states {', '.join(session.states)}")

# %% Photos -> luminaires and reflectances (some 10 s; writes into `out`)
result = luxfit.fit(session_path, out)
print(f"status {result.status}")
for warning in result.warnings:
    print(f"  {warning['code']}: {warning['message']}")

# %% The schedule of luminaires, each with its 95 % interval
print("\nluminaire      x m     y m     z m   +- mm       lm   +- lm")
for name, p, sigma, flux, flux_sigma in zip(result.luminaire_ids, result.position_m, result.position_sigma_m,
                                            result.flux_lm, result.flux_sigma_lm):
    print(f"{name:<10} {p[0]:7.3f} {p[1]:7.3f} {p[2]:7.3f} {1960 * sigma.max():7.1f} {flux:8.0f} {1.96 * flux_sigma:7.0f}")

# %% Reflectances
print()
for name, albedo, sigma in zip(result.material_names, result.albedo, result.albedo_sigma):
    print(f"{name:<12} {albedo:.3f} +- {1.96 * sigma:.3f}")

# %% Measured against predicted, over the readings that the fit did not use
roles = np.array(result.reading_roles)
error_lx = (result.predicted_lx - result.measured_lx)[roles == "check"]
measured_lx = result.measured_lx[roles == "check"]
print(f"\nluxmeter: {error_lx.size} readings, mean error {100 * np.abs(error_lx).mean() / measured_lx.mean():.2f} %, "
      f"worst {100 * np.abs(error_lx / measured_lx).max():.1f} %")

# %% Errors that the luminaires have in common: correlation of two fluxes
fluxes = [f"log flux of {name}" for name in result.luminaire_ids[:2]]
covariance = result.covariance_of(fluxes)
print(f"the fluxes of {result.luminaire_ids[0]} and {result.luminaire_ids[1]} correlate by "
      f"{covariance[0, 1] / np.sqrt(covariance[0, 0] * covariance[1, 1]):.3f}")

# %% Forward: every luminaire's light at the meter's places, once; light adds, so that any dimming is one product
light = luxfit.simulate(session.with_result(out))
places = np.array([session.readings["id"][list(light.sensor_of_reading).index(s)]
                   for s in range(len(light.sensor_position_m))])
desks = light.sensor_position_m[:, 2] > 0.5
print(f"\nillumination of {', '.join(places[desks])} in lx, dimming the first luminaire:")
for level in np.linspace(1, 0, 6):
    dimming = np.ones(len(light.flux_lm))
    dimming[0] = level
    print(f"  {100 * level:3.0f} %   " + "".join(f"{lux:8.1f}" for lux in (light.illuminance_lx @ dimming)[desks]))

# %% Where the light goes: flux that each material receives and gives back, everything on
patches = light.patches
received_lm = patches["area_m2"] * patches["illuminance_lx"].sum(axis=1)
given_lm = patches["area_m2"] * patches["exitance_lm_m2"].sum(axis=1)
print("\nmaterial     received lm   reflected lm")
for index, name in enumerate(patches["materials"]):
    of_material = patches["material"] == index
    print(f"{name:<12} {received_lm[of_material].sum():10.0f} {given_lm[of_material].sum():14.0f}")
