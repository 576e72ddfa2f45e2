"""The order and the size of batches."""

from itertools import groupby

import pytest

from sweep.config.case import Case
from sweep.running.batches import Plan, cost
from tests.support.results.standin import cases


def with_work(steps):
    return Case.of(solver=dict(time_step=0.2 / steps))


def test_cost_counts_steps_and_nodes():
    assert cost(with_work(2000)) == pytest.approx(10 * cost(with_work(200)))
    fine = Case.of(lattice=dict(cells_x=6, cells_y=6))
    assert 4 < cost(fine) / cost(Case.of()) < 16


def test_shortest_case_first_then_the_longest():
    plan = Plan([with_work(steps) for steps in (100, 400, 200, 800, 50)], workers=2)
    (first,) = plan.take()
    assert first == with_work(50)
    plan.learn([first], 1.0)
    order = [case for batch in iter(plan.take, []) for case in batch]
    assert order == [with_work(steps) for steps in (800, 400, 200, 100)]


def test_cases_of_a_lattice_follow_one_another():
    """The lattice is then built once; longer cases go first nevertheless."""
    made = [
        Case.of(
            lattice=dict(width=0.01 * w, cells_x=n),
            material=dict(modulus=1e6 * y, density=1e3),
        )
        for y in (1, 2, 3)
        for w in (1, 2)
        for n in (3, 4)
    ]
    plan = Plan(made, workers=2)
    plan.take()
    plan.learn(made[:1], 1.0)
    order = [case.lattice for batch in iter(plan.take, []) for case in batch]
    assert [lattice.cells_x for lattice in order] == [4] * 6 + [3] * 5
    assert [len(list(run)) for _, run in groupby(order)] in ([3, 3, 3, 2], [3, 3, 2, 3])


def test_batches_hold_about_a_second_and_shrink_towards_the_end():
    plan = Plan(cases(1000), workers=2)
    plan.learn(plan.take(), 0.02)
    sizes = []
    while batch := plan.take():
        sizes.append(len(batch))
        plan.learn(batch, 0.02 * len(batch))
    assert sizes[:6] == [1, 2, 4, 8, 16, 32]  # no more than have been measured
    assert 49 <= sizes[6] <= max(sizes) <= 50
    assert sizes[-1] <= 5
    assert sum(sizes) == 999


def test_compiling_in_the_first_case_is_soon_forgotten():
    plan = Plan(cases(1000), workers=2)
    plan.learn(plan.take(), 30.0)
    for _ in range(8):
        batch = plan.take()
        plan.learn(batch, 0.01 * len(batch))
    assert 20 <= len(plan.take()) <= 100


def test_a_batch_that_is_put_back_comes_again():
    plan = Plan(cases(6), workers=1)
    first = plan.take()
    plan.learn(first, 0.1)
    second = plan.take()
    plan.put_back(second)
    assert len(plan) == 5
    assert plan.take() == second


def test_a_plan_is_quick_if_its_longest_case_is_shorter_than_a_batch():
    plan = Plan(cases(6), workers=1)
    assert not plan.is_quick()  # nothing is known
    plan.learn(plan.take(), 2.0)
    assert not plan.is_quick()
    for _ in range(5):
        plan.learn(cases(6), 0.1)
    assert plan.is_quick()
