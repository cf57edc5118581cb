from grasptypes.seeds import rng, seed


def test_seed_depends_on_the_whole_key_and_on_nothing_else() -> None:
    first = rng("grasps", "mug", "use", 3, 0).random(4).tolist()
    rng("something", "else").random(100)
    assert rng("grasps", "mug", "use", 3, 0).random(4).tolist() == first
    assert rng("grasps", "mug", "use", 4, 0).random(4).tolist() != first


def test_key_parts_do_not_run_together() -> None:
    keys = [("a", "bc"), ("ab", "c"), ("abc",), ("a", 1), ("a", "1"), ("a1",)]
    assert len({seed(*key) for key in keys}) == len(keys)


def test_seed_zero_is_a_seed_like_any_other() -> None:
    assert seed("folds", 0) != seed("folds", 1)
    assert seed("folds", 0) != seed("folds")
