#!/usr/bin/perl
# In the sandbox of skerryd.service: tries what it must not be able to do, and what the server needs.  A line for each;
# exit code 1 if one of them came out otherwise.  Perl is in every Debian, and has syscall().
use strict;
use warnings;
use Errno;
use Socket;

my ($machine) = (split ' ', `/usr/bin/uname -m`)[0];
my %numbers = $machine eq 'aarch64'
  ? (mount => 40, chroot => 51, unshare => 97, ptrace => 117, sched_setscheduler => 119, setpriority => 140, reboot => 142, setuid => 146,
     settimeofday => 170, init_module => 105, bpf => 280, perf_event_open => 241, keyctl => 219, personality => 92, prlimit => 261)
  : (mount => 165, chroot => 161, unshare => 272, ptrace => 101, sched_setscheduler => 144, setpriority => 141, reboot => 169, setuid => 105,
     settimeofday => 164, init_module => 175, bpf => 321, perf_event_open => 298, keyctl => 250, personality => 135, prlimit => 302);
my $wrong = 0;

sub tell_of {
  my ($what, $done, $should) = @_;
  my $how = $done ? 'done' : "refused ($!)";
  $wrong++ if $done != $should;
  printf "%-44s %s%s\n", $what, $how, $done != $should ? '   <-- WRONG' : '';
}
sub called { my ($name, @arguments) = @_; return syscall($numbers{$name}, @arguments) != -1 ? 1 : 0 }
sub written { my $file; return open($file, '>', $_[0]) ? 1 : 0 }
sub socket_of { my $socket; return socket($socket, $_[0], $_[1], $_[2]) ? 1 : 0 }

my ($none, $dir) = ("none\0", "/tmp\0");
tell_of('mount a file system', called('mount', $none, $dir, "tmpfs\0", 0, 0), 0);
tell_of('chroot', called('chroot', $dir), 0);
tell_of('unshare (a user namespace)', called('unshare', 0x10000000), 0);
tell_of('ptrace', called('ptrace', 0, 0, 0, 0), 0);
tell_of('reboot', called('reboot', 0xfee1dead, 672274793, 0), 0);
tell_of('setuid 0', called('setuid', 0), 0);
tell_of('set the clock', called('settimeofday', pack('q2', 0, 0), 0), 0);
tell_of('load a kernel module', called('init_module', 0, 0, $none), 0);
tell_of('bpf', called('bpf', 0, 0, 0), 0);
tell_of('perf_event_open', called('perf_event_open', 0, 0, -1, -1, 0), 0);
tell_of('keyctl', called('keyctl', 0, -3, 0), 0);
tell_of('personality (no random addresses)', called('personality', 0x0040000), 0);
tell_of('a real-time priority', called('sched_setscheduler', 0, 1, pack('i', 1)), 0);
tell_of('raise its own limits', called('prlimit', 0, 7, pack('q2', 1 << 20, 1 << 20), 0), 0);
tell_of('a raw socket of packets', socket_of(17, SOCK_RAW, 0), 0);
tell_of('a raw socket of IPv4', socket_of(AF_INET, SOCK_RAW, 1), 0);
tell_of('write /etc/skerry/skerryd.yaml', written('/etc/skerry/skerryd.yaml'), 0);
tell_of('write /usr/bin/probe', written('/usr/bin/probe'), 0);
tell_of('write /var/log/probe', written('/var/log/probe'), 0);
tell_of('write /proc/sys/kernel/hostname', written('/proc/sys/kernel/hostname'), 0);
tell_of('write /sys/fs/cgroup/probe', written('/sys/fs/cgroup/probe'), 0);
tell_of('see /root', opendir(my $root, '/root') ? 1 : 0, 0);
tell_of('see processes of others', -e '/proc/1' ? 1 : 0, 0);
tell_of('open /dev/mem', open(my $memory, '<', '/dev/mem') ? 1 : 0, 0);
tell_of('make a file executable for all as its owner', do {
  written('/var/lib/skerry/probe');
  my $done = chmod(04755, '/var/lib/skerry/probe');
  unlink '/var/lib/skerry/probe';
  $done ? 1 : 0;
}, 0);

tell_of('write /var/lib/skerry/recordings', do {
  mkdir '/var/lib/skerry/recordings';
  my $done = written('/var/lib/skerry/recordings/probe');
  unlink '/var/lib/skerry/recordings/probe';
  $done;
}, 1);
tell_of('write /dev/shm (rings of boards)', do { my $done = written('/dev/shm/skerry-probe'); unlink '/dev/shm/skerry-probe'; $done }, 1);
tell_of('read a chart in /usr/share', open(my $exercise, '<', '/usr/share/skerry/exercises/crossing.yaml') ? 1 : 0, 1);
open(my $limits, '<', '/proc/self/limits') or die;
my ($nice) = map { /^Max nice priority\s+(\d+)/ ? $1 : () } <$limits>;
tell_of('setpriority to 1', called('setpriority', 0, 0, 1), 1);
tell_of("setpriority to -10 (limit $nice; needs 30)", called('setpriority', 0, 0, -10), $nice >= 30 ? 1 : 0);
tell_of('setpriority to -11', called('setpriority', 0, 0, -11), 0);
tell_of('sockets of IPv4', socket_of(AF_INET, SOCK_DGRAM, 0), 1);
tell_of('sockets of IPv6', socket_of(AF_INET6, SOCK_STREAM, 0), 1);
tell_of('sockets of netlink (interfaces)', socket_of(16, SOCK_RAW, 0), 1);
tell_of('sockets of unix (D-Bus)', socket_of(AF_UNIX, SOCK_STREAM, 0), 1);
printf "%s\n", $wrong ? "$wrong WRONG" : 'all as it should be';
exit($wrong ? 1 : 0);
