"""seiswidgets: seismic image restoration in a notebook.

Unfault and flatten a seismic section after Gilardet, Guillon, Jobard and Komatitsch's method of nonlinear least
squares shape optimisation. The public names are listed here once and loaded when they are first used.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach(
    __name__,
    submodules={"plot"},
    submod_attrs={
        "errors": [
            "Cancelled",
            "DataError",
            "FlippedError",
            "PickError",
            "SectionError",
            "SeiswidgetsError",
            "SettingError",
        ],
        "geology": ["synthetic"],
        "geology.assignment": ["assignment"],
        "geology.bodies": ["Body"],
        "geology.checking": ["check"],
        "geology.comparison": ["PickComparison", "compare_picks"],
        "geology.cutoffs": ["CutOff", "cutoffs", "heave", "throw"],
        "geology.depth_conversion": ["DepthConversion"],
        "geology.ensembles.ensemble": ["Ensemble"],
        "geology.ensembles.uncertainty": ["Uncertainty"],
        "geology.findings": ["Finding"],
        "geology.hypothesis": ["Hypothesis"],
        "geology.correlation": ["cross_fault_correlation", "likeness"],
        "geology.flexure": ["Isostasy"],
        "geology.lithology": ["LITHOLOGIES", "Lithology"],
        "geology.outcomes": ["Comparison", "compare"],
        "geology.picks": ["Fault", "Horizon", "Interpretation"],
        "geology.plan": ["Plan", "Step"],
        "geology.pooling": ["PooledPicks", "pool_picks"],
        "geology.report": ["Report"],
        "geology.restoration": ["Restoration"],
        "geology.section": ["Section"],
        "geology.slip_profile": ["SlipProfile"],
        "geology.stage": ["Stage"],
        "geology.stratigraphy": ["Layer", "Stratigraphy"],
        "geology.velocity": ["ConstantVelocity", "LayerCake", "LinearVelocity", "TimeDepthTable"],
        "geology.weights": ["Weights"],
        "io": ["datasets"],
        "io.session.autosave": ["Autosave"],
        "io.ensembles": ["ensemble"],
        "io.info": ["SectionInfo"],
        "io.exports.meshes": ["save_mesh"],
        "io.opening": ["open_section", "preview"],
        "io.picks": ["read_picks", "write_picks"],
        "io.exports.reports": ["save_report"],
        "io.exports.sections": ["save_section"],
        "io.session.session": ["Session", "open_session"],
        "io.session.sources": ["SectionSource"],
        "io.exports.xarrays": ["displacement", "from_xarray", "to_xarray"],
        "widgets.handout.page": ["save_html"],
        "widgets.app": ["RestorationApp"],
        "widgets.gallery": ["Gallery"],
        "widgets.section_view.pane": ["SectionPane"],
        "widgets.picker": ["Picker"],
        "widgets.histogram": ["DeformationHistogram"],
        "widgets.linked_panes": ["LinkedPanes"],
        "widgets.panels.step_list": ["StepList"],
        "widgets.timeline": ["Timeline"],
        "widgets.panels.weight_sliders": ["WeightSliders"],
    },
)

__version__ = "0.1.0"
