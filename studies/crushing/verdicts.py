"""What the study says, in sentences that are made of its numbers."""

import numpy as np
import pandas as pd

from branchcrush.branches.crushing_forms import FORM_LABELS

HELD_OUT = ("size_exponent_05", "size_exponent_2", "hertz", "limit_eighth")
# Wang and Arson (2018): at least this share of the work is redistributed.
_REDISTRIBUTED = 60.0


def verdict_block(
    study: pd.DataFrame,
    steps: pd.DataFrame,
    growth: pd.DataFrame,
    errors: pd.DataFrame,
    forms: pd.DataFrame,
    who: pd.DataFrame,
) -> list[str]:
    """Return a line for each question."""
    if not len(study):
        return ["Nothing of this was crushed yet."]
    lines = [*_line(study), *_limit(study), *_energy(study), *_steps(steps), *_growth(growth)]
    lines += [*_held_out(errors), *_forms(forms), *_who(who)]
    return [f"- {line}" for line in lines]


def _line(study):
    known = study.dropna(subset=["slope_low"])
    holds = {
        law: int(known[law].between(known["slope_low"], known["slope_high"]).sum())
        for law in ("slope_by_strength", "slope_by_number_exponent")
    }
    half = float(((known["slope_high"] - known["slope_low"]) / 2.0).median())
    off = 100.0 * (study["log_stress_factor"] - 1.0)
    yield (
        "**Slope of the compression line.** McDowell and de Bono's 1/(2b) is within the interval "
        f"of {holds['slope_by_strength']} of {len(known)} cases, (3 − α)/b with the α that the "
        f"gradings have of {holds['slope_by_number_exponent']}; with two or three packings the "
        f"intervals are wide, ± {half:.2f} in the middle of the cases. From the simulated gradings "
        f"alone (φ_J and stiffness by rods) the stress is right within {off.min():.0f} to "
        f"{off.max():.0f} %, and the slope is {study['predicted_slope'].min():.2f} to "
        f"{study['predicted_slope'].max():.2f} where {study['slope'].min():.2f} to "
        f"{study['slope'].max():.2f} are measured."
    )
    yield (
        "**Jamming point.** By rods from the gradings that crushing makes it is "
        f"{study['jamming_by_rods_difference'].min():+.4f} to "
        f"{study['jamming_by_rods_difference'].max():+.4f} above φ (1 − ε_e), with a scatter of "
        f"{study['jamming_by_rods_scatter'].max():.4f} or less. The packings stay near jamming: "
        f"ε_e is {100 * study['elastic_strain_least'].min():.1f} to "
        f"{100 * study['elastic_strain_largest'].max():.1f} % while they yield."
    )


def _limit(study):
    told = study.set_index("sample")
    if not {"base", "limit_eighth"} <= set(told.index):
        return
    base, finer = told.loc["base"], told.loc["limit_eighth"]
    yield (
        "**Fractal exponent.** At φ = 0.72 α is "
        f"{base['exponent_at_072']:.2f} with a limit of d₀/4 and {finer['exponent_at_072']:.2f} "
        "with d₀/8: at equal φ a finer limit does not bring it nearer to 2.5, since α grows with "
        f"the mass that is broken ({100 * base['final_broken_mass_fraction']:.0f} and "
        f"{100 * finer['final_broken_mass_fraction']:.0f} % at their ends). It was not reached: "
        f"the largest of all cases is {study['number_exponent'].max():.2f}."
    )


def _energy(study):
    share = 100.0 * (study["avalanches_share"] + study["rearrangement_share"])
    parents = 100.0 * study["released_by_parents_share"]
    above = int((share >= _REDISTRIBUTED).sum())
    yield (
        "**Where the work goes.** Avalanches and rearrangement take "
        f"{share.min():.0f} to {share.max():.0f} % of it, at least {_REDISTRIBUTED:.0f} % (Wang "
        f"and Arson's redistribution) in {above} of {len(study)} cases; the contacts of the grains "
        f"that broke held {parents.min():.0f} to {parents.max():.0f} %. Moving the jamming point, "
        f"∫ p dφ_J, is {study['compaction_over_dissipated'].min():.2f} to "
        f"{study['compaction_over_dissipated'].max():.2f} of all that is lost."
    )


def _steps(steps):
    if not len(steps):
        return
    plain = steps[(steps["stepping"] == "strain_step") & (steps["step_tolerance"] == 1e-2)]
    excess, without, together = [], [], []
    for step, group in plain.groupby("strain_step", sort=False):
        free = 100.0 * (group["rearrangement_share"] - group["step_excess_share"])
        excess.append(f"{100 * group['step_excess_share'].mean():.1f} % at {step:g}")
        without.append(f"{free.mean():.1f} ± {free.sem():.1f}")
        together.append(f"{100 * group['rearrangement_share'].mean():.0f}")
    yield (
        "**Does the split converge?** What rearrangement takes fell with the strain step "
        f"({', '.join(together)} % of the work) because an affine step of finite size takes more "
        f"work than small ones: {', '.join(excess)}, in proportion to the step. Without it "
        f"rearrangement takes {', '.join(without)} %, which shows no trend beyond its scatter. So "
        "rearrangement less the part of the strain step is what can be trusted, at any of these "
        "steps; the default stays."
    )


def _growth(growth):
    others = growth[growth["growth_stages"] != 5] if len(growth) else growth
    if len(others):
        change = 100.0 * (others["over_base"] - 1.0)
        yield (
            f"**Growth of fragments.** From 0 to {others['growth_stages'].max()} stages what "
            f"breakage takes changes by {change.min():+.0f} to {change.max():+.0f} %, though "
            f"growth puts in {growth['growth_J'].min():.2g} to {growth['growth_J'].max():.2g} J."
        )


def _held_out(errors):
    here = errors[errors["sample"].isin(HELD_OUT)] if len(errors) else errors
    if not len(here):
        return
    most = here.groupby("quantity")["rms_ln"].max()
    yield (
        "**Without a simulation.** What was predicted from grading and strength alone, before "
        f"these packings were made, is off (rms of ln, the worst of {here['sample'].nunique()} "
        f"held-out cases) by {most['broken_mass_fraction']:.2f} in the broken mass, "
        f"{most['einav_breakage']:.2f} in Einav's B, {most['number_exponent']:.2f} in α, "
        f"{most['grains_ratio']:.2f} in the number of grains, {most['mean_stress_Pa']:.2f} in the "
        f"stress, {most['dissipated_J_per_m3']:.2f} in what is lost and "
        f"{most['coordination_number']:.2f} in κ."
    )


def _forms(forms):
    if not len(forms):
        return
    whole = forms[forms["stress_states"] == forms["states"]]
    parts = []
    for form, group in whole.groupby("form", sort=False):
        stress, lost = (np.exp(group[f"{name}_bias_ln"]) for name in ("stress", "dissipated"))
        parts.append(
            f"{FORM_LABELS[form]}: stress {stress.min():.2f} to {stress.max():.2f} times, lost "
            f"{lost.min():.2f} to {lost.max():.2f} times"
        )
    yield (
        "**Forms of the model** beside the simulated (geometric means over the states): "
        f"{'; '.join(parts)}."
    )


def _who(who):
    here = who[who["among"] == "bearing"] if len(who) else who
    if not len(here):
        return
    area = here.pivot(index="foreteller", columns="sample", values="area")

    def between(name):
        return f"{area.loc[name].min():.2f} to {area.loc[name].max():.2f}"

    yield (
        "**Who breaks** (area under the ROC curve, among grains that carry load): stress over "
        f"strength {between('stress_over_strength')}, stress alone {between('stress')}, the "
        f"largest force {between('largest_force')}, the energy that the paper's split gives it "
        f"{between('split_energy')}."
    )
