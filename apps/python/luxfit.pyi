"""Inverse-lighting calibration of rooms: photos -> luminaires and reflectances -> luxmeter check.

World frame right-handed, z up, metres; fluxes lm, illuminance lx, exitance lm/m2, intensity cd. Quantities that the data do not determine are NaN
in arrays and None in dicts. Shapes: K luminaires, M materials, V views, S places of readings, n readings, P patches, N elements, p parameters.
"""
# Installed as the stub-only package luxfit-stubs: mypy reads no stub that lies beside a single-file module of an installed Python.
import os
from collections.abc import Sequence
from typing import Any, Literal, NoReturn, Optional, TypedDict, Union

import numpy
from numpy.typing import ArrayLike, NDArray

_Path = Union[str, bytes, os.PathLike[str], os.PathLike[bytes]]
_Numbers = Union[Sequence[float], NDArray[numpy.floating[Any]], NDArray[numpy.integer[Any]]]
# Not Mapping: pybind11 takes dicts only.
_Albedo = Union[dict[str, float], dict[str, int]]
_Unit = Literal["m", "cm", "mm", "in", "ft"]
_Shape = Literal["point", "disc", "rectangle", "sphere"]
_Role = Literal["fit", "scale", "check"]
_Furniture = Literal["find", "given"]

# The metaclass of every class that pybind11 makes.
class _Pybind11Type(type): ...

class _Photometry(TypedDict):
    """An .ies or .ldt file: C planes, G angles gamma."""

    format: str
    keywords: list[tuple[bytes, bytes]]  # name and text, as in the file
    c_deg: NDArray[numpy.float64]  # (C,), over the whole circle
    gamma_deg: NDArray[numpy.float64]  # (G,), from the nadir
    cd_per_klm: NDArray[numpy.float64]  # (C, G), per 1000 lm of flux_lm
    flux_lm: float  # the integral
    stated_flux_lm: Optional[float]
    lamp_flux_lm: Optional[float]
    shape: _Shape
    size_m: NDArray[numpy.float64]  # (2,): along C0 and across
    notes: list[str]

class _Patches(TypedDict):
    """The patches of a room."""

    center_m: NDArray[numpy.float64]  # (P, 3)
    normal: NDArray[numpy.float64]  # (P, 3), unit
    area_m2: NDArray[numpy.float64]  # (P,)
    material: NDArray[numpy.int32]  # (P,), index of materials
    vertices_m: NDArray[numpy.float64]  # (P, 4, 3); a triangle has its last corner twice

class _Elements(TypedDict):
    """The elements of a room."""

    center_m: NDArray[numpy.float64]  # (N, 3)
    normal: NDArray[numpy.float64]  # (N, 3), unit
    area_m2: NDArray[numpy.float64]  # (N,)
    patch: NDArray[numpy.int32]  # (N,), index of patches

class _SensorLight(TypedDict):
    """Light at sensors, by luminaire at its flux."""

    illuminance_lx: NDArray[numpy.float64]  # (S, K)
    direct_lx: NDArray[numpy.float64]  # (S, K), its direct part

class _PatchLight(TypedDict):
    """Light of patches, by luminaire at its flux."""

    illuminance_lx: NDArray[numpy.float64]  # (P, K)
    exitance_lm_m2: NDArray[numpy.float64]  # (P, K); luminance in cd/m2 is exitance / pi

class _LitPatches(_Patches, _PatchLight):
    """The patches of a simulation, with their light by luminaire at full flux."""

    materials: list[str]

class _Scene(TypedDict):
    """The [scene] of a session."""

    mesh: Optional[str]  # None: a size or an outline
    corners_m: Optional[NDArray[numpy.float64]]  # (n, 2) of the outline; None for a mesh
    heights_m: Optional[NDArray[numpy.float64]]  # (n,) of the ceiling over the corners
    unit: str
    metres_per_unit: float
    albedo_rgb: dict[str, NDArray[numpy.float64]]  # (3,) of each material that is given
    neutral: list[str]  # materials that are white or grey

class _Tag(TypedDict):
    """A surveyed tag."""

    id: int
    size_m: float
    center_m: NDArray[numpy.float64]  # (3,)
    normal: NDArray[numpy.float64]  # (3,), unit
    up: NDArray[numpy.float64]  # (3,), unit

class _Camera(TypedDict):
    """A [[camera]] of a session."""

    id: str
    intrinsics: Optional[str]  # path; None: to be calibrated
    response: str  # linear, estimate or a path
    vignetting: str  # none, estimate or a path
    black_level: float  # counts
    cdm2_per_count_s: float  # cd/m2 per count and second, NaN where unknown
    luminance_weights: NDArray[numpy.float64]  # (3,), of R, G and B
    xyz_from_rgb: Optional[NDArray[numpy.float64]]  # (3, 3), as given or as the photos state it; None: unknown

class _Photos(TypedDict):
    """The photo table of a session, by columns."""

    file: list[str]
    camera: list[str]
    view: list[str]
    state: list[str]
    exposure_s: NDArray[numpy.float64]  # (photos,), NaN where the table leaves it to the file

class _GivenLuminaire(TypedDict):
    """The keys that a session gives for a luminaire; None where it gives none."""

    id: str
    photometry: str
    cosine_exponent: Optional[float]
    shape: Optional[_Shape]
    size_m: list[float]
    position_m: Optional[NDArray[numpy.float64]]  # (3,)
    position_sigma_m: Optional[float]
    aim: Optional[NDArray[numpy.float64]]  # (3,), unit
    heading: Optional[NDArray[numpy.float64]]  # (3,), unit
    flux_lm: Optional[float]
    flux_sigma_lm: Optional[float]

class _Warning(TypedDict):
    """A warning of docs/warnings.md."""

    code: str
    message: str
    remedy: str

class _Choice(TypedDict):
    """A choice between models."""

    what: str
    chosen: str
    among: list[str]
    because: str

class _Readings(TypedDict):
    """The readings of a session's luxmeter, by columns."""

    id: list[str]
    state: list[str]
    role: list[_Role]
    position_m: NDArray[numpy.float64]  # (n, 3)
    normal: NDArray[numpy.float64]  # (n, 3), unit
    illuminance_lx: NDArray[numpy.float64]  # (n,), NaN where nothing was measured

__version__: str

class InputError(ValueError):
    """An error in a file or argument: FILE:LINE: key: expected X, got Y; remedy."""

class MissingProgramError(RuntimeError):
    """Names a program that is needed and not installed, with its Debian package."""

class Luminaire(metaclass=_Pybind11Type):
    """A luminaire: position, aim, flux, distribution and shape, with the keys of a session's [[luminaire]]."""

    def __init__(
        self,
        position_m: ArrayLike,
        flux_lm: Optional[float] = None,
        photometry: str = "lambertian",
        *,
        aim: ArrayLike = ...,
        heading: ArrayLike = ...,
        shape: Optional[_Shape] = None,
        size_m: _Numbers = ...,
        cosine_exponent: Optional[float] = None,
        gamma_deg: _Numbers = ...,
        cd_per_klm: _Numbers = ...,
        id: str = "",
    ) -> None:
        """Makes a luminaire at position_m (3,), of flux_lm.

        photometry: isotropic, lambertian, cosine_power (with cosine_exponent), table (with gamma_deg and cd_per_klm) or the path of an .ies
        or .ldt file, whose flux, shape and size count where none are given. aim (3,): gamma = 0, downwards by default. heading (3,): the C0
        half-plane and the direction of size_m[0], along x by default.
        """
    id: str
    @property
    def position_m(self) -> NDArray[numpy.float64]:
        """(3,): centre, world frame, m."""
    @position_m.setter
    def position_m(self, value: ArrayLike) -> None: ...
    @property
    def aim(self) -> NDArray[numpy.float64]:
        """(3,), unit: gamma = 0. Takes any length but 0."""
    @aim.setter
    def aim(self, value: ArrayLike) -> None: ...
    @property
    def heading(self) -> NDArray[numpy.float64]:
        """(3,), unit, perpendicular to aim: C0. Takes any length but 0."""
    @heading.setter
    def heading(self, value: ArrayLike) -> None: ...
    @property
    def flux_lm(self) -> float:
        """Luminous flux, lm."""
    @flux_lm.setter
    def flux_lm(self, value: float) -> None: ...
    @property
    def photometry(self) -> str:
        """The distribution: isotropic, lambertian, cosine_power, or measured for tables and photometric files."""
    @property
    def shape(self) -> _Shape:
        """The shape of the luminous opening."""
    @property
    def size_m(self) -> NDArray[numpy.float64]:
        """(2,): along heading and across, m; 0 where the shape has none."""
    def intensity_cd(self, directions: ArrayLike) -> NDArray[numpy.float64]:
        """Returns the luminous intensity in cd (n,) towards world directions (n, 3) of any length but 0."""

class Room(metaclass=_Pybind11Type):
    """A mesh cut into patches, which send light, and elements, which receive it, with its form factors."""

    def __init__(
        self,
        mesh: _Path,
        unit: _Unit = "m",
        *,
        patch_size_m: float = 0.4,
        element_size_m: Optional[float] = None,
        method: str = "hybrid",
        rays: int = 64,
    ) -> None:
        """Reads a mesh (OBJ, PLY: z up; glTF: y up, turned) of that unit, or the room of a session file (.toml), and computes its form factors.

        element_size_m: patch_size_m / 4 by default. method: one of help(luxfit.Room). rays: over the hemisphere of an element.
        """
    @property
    def materials(self) -> list[str]:
        """The names of the materials, M."""
    @property
    def patches(self) -> _Patches:
        """The patches: centres and corners m, normals, areas m2, materials."""
    @property
    def elements(self) -> _Elements:
        """The elements: centres m, normals, areas m2, patches."""
    @property
    def form_factors(self) -> NDArray[numpy.float32]:
        """F (N, P), read-only: share of what leaves element i that reaches patch j. Rows add up to 1 in a closed room."""
    @property
    def closure_error(self) -> float:
        """Root mean square of 1 - row sum before it is enforced."""
    def illuminance(self, luminaires: Sequence[Luminaire], position_m: ArrayLike, normal: ArrayLike, albedo: _Albedo) -> _SensorLight:
        """Returns the illuminance in lx (S, K) at sensors: position_m (S, 3) in m, normal (S, 3) of any length but 0.

        albedo: a reflectance in [0, 1) for every material. Light adds: E(dimming) = illuminance_lx @ dimming.
        """
    def patch_light(self, luminaires: Sequence[Luminaire], albedo: _Albedo) -> _PatchLight:
        """Returns the illuminance in lx and the exitance in lm/m2 (P, K) of the patches."""

class Session(metaclass=_Pybind11Type):
    """A session file and the tables it names, read and checked (read_session)."""

    def __init__(self, *args: NoReturn, **kwargs: NoReturn) -> None: ...  # no constructor
    @property
    def name(self) -> str:
        """The name of the session."""
    @property
    def path(self) -> str:
        """The absolute path of the session file."""
    @property
    def scene(self) -> Optional[_Scene]:
        """The mesh or the outline, its unit and the reflectances that are given; None without [scene]."""
    @property
    def tags(self) -> list[_Tag]:
        """The surveyed tags, lengths in m."""
    @property
    def cameras(self) -> list[_Camera]:
        """The cameras."""
    @property
    def photos(self) -> _Photos:
        """The photos, exposures in s."""
    @property
    def groups(self) -> dict[str, list[str]]:
        """{group: [luminaires]}, those that are switched together."""
    @property
    def states(self) -> dict[str, dict[str, float]]:
        """{state: {luminaire: dimming 0..1}}, those that are on."""
    @property
    def dimming(self) -> NDArray[numpy.float64]:
        """(states, K), 0..1, in the order of states and luminaires."""
    @property
    def luminaires(self) -> list[_GivenLuminaire]:
        """The keys given for each luminaire, lengths in m, fluxes in lm."""
    @property
    def readings(self) -> _Readings:
        """The readings: places in m, illuminance in lx."""
    def with_result(self, out: _Path) -> Session:
        """Returns the session with the luminaires and reflectances of a result (its folder or result.json)."""

class Simulation(metaclass=_Pybind11Type):
    """Light of a session that gives everything (simulate). Columns are luminaires at full flux: light adds."""

    def __init__(self, *args: NoReturn, **kwargs: NoReturn) -> None: ...  # no constructor
    @property
    def luminaire_ids(self) -> list[str]:
        """The ids of the luminaires, K."""
    @property
    def flux_lm(self) -> NDArray[numpy.float64]:
        """(K,): full flux, lm."""
    @property
    def sensor_position_m(self) -> NDArray[numpy.float64]:
        """(S, 3): the places of the readings, each once, m."""
    @property
    def sensor_normal(self) -> NDArray[numpy.float64]:
        """(S, 3), unit."""
    @property
    def illuminance_lx(self) -> NDArray[numpy.float64]:
        """(S, K): illuminance at those places, lx."""
    @property
    def direct_lx(self) -> NDArray[numpy.float64]:
        """(S, K): its direct part, lx."""
    @property
    def sensor_of_reading(self) -> list[int]:
        """The index of its place for every reading of the session, n."""
    @property
    def reading_lx(self) -> NDArray[numpy.float64]:
        """(n,): predicted for every reading of the session, in its state, lx."""
    @property
    def reading_direct_lx(self) -> NDArray[numpy.float64]:
        """(n,): its direct part, lx."""
    @property
    def patches(self) -> _LitPatches:
        """The patches with their illuminance in lx and exitance in lm/m2."""
    @property
    def estimated_error_percent(self) -> float:
        """Error of the illuminance at the readings' places, root mean square, %."""

class _Fitted(metaclass=_Pybind11Type):
    """Holds the properties that Result and RoomFit share. The module itself has no such class."""

    def __init__(self, *args: NoReturn, **kwargs: NoReturn) -> None: ...  # no constructor
    @property
    def luminaire_ids(self) -> list[str]:
        """The ids of the luminaires, K."""
    @property
    def position_m(self) -> NDArray[numpy.float64]:
        """(K, 3): centres, world frame, m."""
    @property
    def position_sigma_m(self) -> NDArray[numpy.float64]:
        """(K, 3): their sigmas, m."""
    @property
    def flux_sigma_lm(self) -> NDArray[numpy.float64]:
        """(K,): their sigmas, lm."""
    @property
    def predicted_lx(self) -> NDArray[numpy.float64]:
        """(n,): predicted illuminance, lx."""
    @property
    def prediction_sigma_lx(self) -> NDArray[numpy.float64]:
        """(n,): sigmas of the predictions, model error included, lx."""
    def illuminance(self, position_m: ArrayLike, normal: ArrayLike, dimming: dict[str, float]) -> NDArray[numpy.float64]:
        """Illuminance in lx at places (S,), as predicted_lx: with bodies and colours. position_m, normal (S, 3).

        dimming: {luminaire: 0..1}; the others are off. Of a Result, the meter is that of the session.
        """

class Result(_Fitted):
    """Result of a fit. Lists of dicts have the keys of result.json; arrays are in the order of those lists, NaN where undetermined."""

    @property
    def summary(self) -> dict[str, Any]:
        """The mean and the largest error of the readings that check, lx and %, and their number."""
    @property
    def luminaires(self) -> list[dict[str, Any]]:
        """The luminaires, K."""
    @property
    def materials(self) -> list[dict[str, Any]]:
        """The materials, M."""
    @property
    def views(self) -> list[dict[str, Any]]:
        """The views with their camera poses, V."""
    @property
    def luxmeter(self) -> list[dict[str, Any]]:
        """The readings, measured and predicted, n."""
    @property
    def choices(self) -> list[dict[str, Any]]:
        """The choices between models: what, chosen, among, because."""
    @property
    def warnings(self) -> list[dict[str, Any]]:
        """The warnings: code, message, remedy."""
    @property
    def whole(self) -> dict[str, Any]:
        """All of result.json."""
    @property
    def status_because(self) -> list[str]:
        """The codes of the warnings that say what is undetermined; empty where nothing is."""
    @property
    def status(self) -> str:
        """done, or undetermined (see warnings)."""
    @property
    def aim(self) -> NDArray[numpy.float64]:
        """(K, 3), unit: gamma = 0."""
    @property
    def flux_lm(self) -> NDArray[numpy.float64]:
        """(K,): fluxes, lm."""
    @property
    def material_names(self) -> list[str]:
        """The names of the materials, M."""
    @property
    def albedo(self) -> NDArray[numpy.float64]:
        """(M,): reflectances, 0..1."""
    @property
    def albedo_sigma(self) -> NDArray[numpy.float64]:
        """(M,): their sigmas."""
    @property
    def camera_position_m(self) -> NDArray[numpy.float64]:
        """(V, 3): camera centres, world frame, m."""
    @property
    def reading_ids(self) -> list[str]:
        """The ids of the readings, n."""
    @property
    def reading_states(self) -> list[str]:
        """The states of the readings, n."""
    @property
    def reading_roles(self) -> list[_Role]:
        """The roles of the readings, n."""
    @property
    def measured_lx(self) -> NDArray[numpy.float64]:
        """(n,): measured illuminance, lx."""
    @property
    def parameter_names(self) -> list[str]:
        """The names of parameters and of the rows of covariance, p."""
    @property
    def parameters(self) -> NDArray[numpy.float64]:
        """(p,), as fitted: positions and sizes m, tilts rad, reflectances; logarithms where the name says so."""
    @property
    def covariance(self) -> NDArray[numpy.float64]:
        """(p, p) of the parameters, in their units; empty where there is none."""
    def covariance_of(self, names: Sequence[str]) -> NDArray[numpy.float64]:
        """Returns the covariance of these parameters alone."""
    def position_covariance_m2(self, id: str) -> NDArray[numpy.float64]:
        """Returns the covariance (3, 3) of a luminaire's estimated position, m2."""

class RoomFit(_Fitted):
    """Result of fit_room. Luminaires are those that were found; NaN where the data determine nothing."""

    @property
    def flux_lm(self) -> NDArray[numpy.float64]:
        """(K,): fluxes, lm; relative where is_absolute is False."""
    @property
    def is_absolute(self) -> bool:
        """Whether a reading gives the scale, so that fluxes are in lm."""
    @property
    def albedo(self) -> dict[str, float]:
        """The reflectance of each material, 0..1."""
    @property
    def status(self) -> Literal["done", "undetermined"]:
        """done, or undetermined (see warnings)."""
    @property
    def warnings(self) -> list[_Warning]:
        """The warnings."""
    @property
    def choices(self) -> list[_Choice]:
        """The choices between models: what, chosen, among, because."""

def read_photometry(path: _Path) -> _Photometry:
    """Reads an .ies or .ldt file: angles deg, intensities cd per 1000 lm, fluxes lm, sizes m."""

def write_photometry(path: _Path, luminaire: Luminaire, test: str = "") -> None:
    """Writes a luminaire's distribution, flux and opening as .ies (LM-63-2002) or .ldt, by the ending."""

def read_session(path: _Path) -> Session:
    """Reads a session file with all its tables. Raises InputError naming file, line and key."""

def simulate(session: Session, *, error_percent: float = 1.0, threads: int = 0) -> Simulation:
    """Computes illuminance and patches of a session that gives everything, to that error in %. threads: 0 for all."""

def read_result(out: _Path) -> Result:
    """Reads the result of an earlier run: its folder, or result.json in it. Raises InputError for anything else."""

def fit(session: _Path, out: _Path, *, threads: int = 0, fresh: bool = False, luminaires: Optional[_Path] = None, budget_s: float = 120.0, apply: bool = False) -> Result:
    """Runs what `luxfit run SESSION -o OUT` runs and returns the Result; progress goes to standard error.

    luminaires: result.json of an earlier fit whose luminaires count as given. fresh: takes over no stage of an earlier run. threads: 0 for all.
    apply: take explanations of mistakes in the session that stand alone, as `luxfit run --apply` does.
    budget_s: after it the fit ends with the best state so far (key "stopped" of the result), as it does at Ctrl-C.
    """

run = fit

def fit_room(
    room: Room,
    states: dict[str, Any],
    *,
    photos: Sequence[dict[str, Any]] = ...,
    cameras: Sequence[_Path] = ...,
    tags: Optional[_Path] = None,
    readings: Sequence[dict[str, Any]] = ...,
    albedo: _Albedo = ...,
    tag_family: str = "tag36h11",
    furniture: _Furniture = "find",
    threads: int = 0,
) -> RoomFit:
    """Fits luminaires and reflectances to linear photos and luxmeter readings, without a session file.

    states: {state: {luminaire: dimming 0..1}}. photos: file, view, state, exposure_s and camera (index of cameras, default 0). cameras:
    calibration files. tags: the survey (JSON). readings: position_m (3,), normal (3,), state, illuminance_lx and used (default True; False:
    only predicted). albedo: known reflectances by material. furniture: "find" (what photos show and the room lacks, or has elsewhere, takes
    part in the fit) or "given" (not looked for). threads: 0 for all.
    """
